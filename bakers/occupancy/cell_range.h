// The range of values that a runtime can see in each cell: the smallest and the largest value that
// a lookup with the volume's filter can return at any position within it, faces included.
//
// Trilinear: along an axis the interpolant is linear between voxel centres, and a cell's faces lie
// midway between two of them. So the centres cut a cell into boxes, smaller ones at its faces, in
// each of which the interpolant is affine in each coordinate with the others held. The extremes of
// such a function are at corners of the box: from any point, going along one axis after the other
// towards the better end reaches one. The corners are the products of three nodes. The nodes on an
// axis are the centres of the cell's voxels and its two faces. The values at the corners,
//     voxels, and the means of 2, 4, 8 voxels on either side of faces, edges and corners,
// are therefore necessary and sufficient. At the bottom and top of the volume, where lookups are
// clamped, the two voxels beside the face are the same one.
//
// Nearest: the range is that of the cell's own voxels.
//
// Tricubic, as the uniform B-spline: weights are >= 0 and sum to 1, so that values lie within the
// range of the voxels used. A position p of an axis uses voxels floor(p - 1/2) - 1 to
// floor(p - 1/2) + 2: over [a, b] these are a - 2 to b + 1, two beyond each face. The range is
// conservative: the spline smooths, and reaches the bounds only where the voxels are equal.
//
// Rounding: `maximum` is the least float that is not below the exact maximum of the stored values'
// filter, `minimum` the greatest float that is not above the exact minimum; neither is ever -0. So
// for any float t, 0 and denormals included, maximum > t exactly where some filtered value is
// greater than t.
#pragma once

#include <array>
#include <vector>

#include "bakers/field/level.h"
#include "bakers/math/bake_options.h"
#include "bakers/occupancy/cell_grid.h"
#include "config/sections/pixel_types.h"

namespace skybake::occupancy {

struct CellRanges {
    std::array<int, 3> size{};   // cells along x, y, z
    std::vector<float> minimum;  // one per cell, x fastest, then y, then z
    std::vector<float> maximum;
};

// Computes the ranges of a volume in memory: grid.voxels floats, x fastest, all finite.
CellRanges cell_ranges(const float* voxels, const CellGrid& grid, config::OccupancyFilter filter,
                       int threads = 1);

// One channel of a volume that is read from a source.
struct ChannelSource {
    const VoxelSource& voxels;
    int channel = 0;
    int channels = 1;                           // number of channels of the source
    PixelType pixel_type = PixelType::float32;  // the type in which it is stored
};

// Computes the ranges of the values as stored. Apart from the result, the memory does not grow with
// the volume. The result does not depend on the number of threads; it is incomplete once
// options.progress is cancelled.
CellRanges cell_ranges(const ChannelSource& source, const CellGrid& grid,
                       config::OccupancyFilter filter, const BakeOptions& options);

}  // namespace skybake::occupancy
