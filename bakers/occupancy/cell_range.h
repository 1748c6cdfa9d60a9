// What a runtime can see in each cell: the smallest and the largest value that a lookup with the
// volume's filter can return at any position within it, faces included.
//
// Trilinear. Along an axis the interpolant is linear between voxel centres, and a cell's faces lie
// midway between two of them. So the centres cut a cell into boxes, smaller ones at its faces, on
// each of which the interpolant is affine in each coordinate with the others held. Such a function
// is extreme at a corner of the box: walk along one axis after the other towards the better end.
// The corners are the products of three nodes, which on an axis are the centres of the cell's
// voxels and its two faces, so that the values there,
//     voxels, and the means of 2, 4, 8 voxels on either side of faces, edges and corners,
// are necessary and sufficient. At the bottom and top of the volume, where lookups are clamped, the
// two voxels beside the face are the same one.
//
// Nearest. The cell's own voxels.
//
// Tricubic, as the uniform B-spline: weights are >= 0 and sum to 1, so that values lie within the
// range of the voxels they are made of. A position p of an axis uses voxels floor(p - 1/2) - 1 to
// floor(p - 1/2) + 2: over [a, b] these are a - 2 to b + 1, two beyond each face. Conservative: the
// spline smooths, and reaches the bounds only where the voxels are equal.
//
// Rounding. `maximum` is the least float that is not below the exact maximum of the stored values'
// filter, `minimum` the greatest not above the exact minimum; never -0. So for any float t,
// maximum > t exactly where some filtered value is greater than t, 0 and denormals included.
#pragma once

#include <array>
#include <vector>

#include "bakers/field/baked.h"
#include "bakers/math/bake_options.h"
#include "bakers/occupancy/cell_grid.h"
#include "config/assets/occupancy.h"
#include "config/sections/files.h"

namespace skybake::occupancy {

struct CellRanges {
    std::array<int, 3> size{};   // cells along x, y, z
    std::vector<float> minimum;  // one per cell, x fastest, then y, then z
    std::vector<float> maximum;
};

// Of a volume in memory: grid.voxels floats, x fastest, all finite.
CellRanges cell_ranges(const float* voxels, const CellGrid& grid, config::OccupancyFilter filter,
                       int threads = 1);

// The channel of a larger volume to look at.
struct ChannelSource {
    const VoxelSource& voxels;
    int channel = 0;
    int channels = 1;                                           // of the source
    config::PixelType pixel_type = config::PixelType::float32;  // as which it is stored
};

// Of the values as stored, in memory that does not grow with the volume besides the result. The
// result does not depend on the number of threads; it is unfinished once options.progress is
// cancelled.
CellRanges cell_ranges(const ChannelSource& source, const CellGrid& grid,
                       config::OccupancyFilter filter, const BakeOptions& options);

}  // namespace skybake::occupancy
