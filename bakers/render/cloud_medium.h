// A cloud volume as rays see it: what a lookup returns, what extinction that is, and how far a ray
// may leap without seeing anything.
//
// Positions are in voxel units: voxel i of an axis has its centre at i + 1/2. The volume repeats
// along x and y, or stands alone with nothing beside it; along z it is clamped, and there is
// nothing below 0 and above size[2].
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "bakers/math/memory.h"
#include "bakers/occupancy/occupied_cells.h"
#include "config/sections/cloud.h"

namespace skybake {

// From a lookup's value v to extinction: extinction_per_m * v * smoothstep(threshold, threshold +
// edge_softness, v) where the threshold comes after filtering, else extinction_per_m * v.
struct CloudOptics {
    double extinction_per_m = 0;
    bool has_edge = false;
    double threshold = 0;
    double edge_softness = 0;
};

CloudOptics cloud_optics(const config::Cloud& cloud);

// Extinction over extinction_per_m, of a value in double.
double density(const CloudOptics& optics, double value);

// Voxels with one more on each side, so that the eight voxels of any lookup are where they should
// be: of the next tile along x and y, or 0 where there is none; the same again along z.
struct PaddedVolume {
    std::array<int, 3> size{};  // without the padding
    AlignedFloats values;       // (size + 2)^3, x fastest

    std::ptrdiff_t row() const { return size[0] + 2; }
    std::ptrdiff_t plane() const { return row() * (size[1] + 2); }
};

// Of channel `channel` of `channels` interleaved ones. At most 2^31 - 1 padded voxels.
PaddedVolume padded_volume(const float* voxels, const std::array<int, 3>& size, int channel,
                           int channels, int threads, bool repeats = true);

// How far a ray may leap: everything within `reach` voxels of an empty cell's faces is empty; -1
// where a cell is occupied.
struct LeapGrid {
    int cell = 1;  // voxels along each edge, a power of two
    std::array<int, 3> cells{};
    std::vector<float> reach;  // x fastest
};

// `leaps` are Chebyshev distances in cells to the nearest occupied one (leap_distance.h), 0 in
// occupied cells. A box of L - 1 cells about a cell has (L - 1) * cell voxels on each side, less
// what the tile's last cells lack where `cell` does not divide the size: at most one of them in
// every tile of cells.
LeapGrid leap_grid(const std::array<int, 3>& voxels, int cell, const std::vector<float>& leaps);

struct CloudMedium {
    std::array<double, 3> extent_m{};  // of the tile, and the layer's height
    double base_m = 0;                 // altitude of z = 0
    bool repeats = true;               // along x and y
    CloudOptics optics;
    PaddedVolume volume;
    // A lookup in float above this is something. Roundings of a trilinear lookup in float, three
    // nested interpolations a + t (b - a) of at most 5 units of 2^-24 each, are less than 2^-20 of
    // the greatest magnitude of a voxel: this is so much above the threshold, so that nothing that
    // exact arithmetic calls empty can be something. With threshold 0 and no negative voxels it is
    // 0, since sums and products of zeros are exact.
    float visible_above = 0;
    LeapGrid leaps;

    double meters_per_voxel(std::size_t axis) const { return extent_m[axis] / volume.size[axis]; }
};

// Without leaps: all cells are occupied. Leaps of a volume that repeats hold for one that does not,
// which has less.
CloudMedium cloud_medium(const config::Cloud& cloud, const float* voxels,
                         const std::array<int, 3>& size, int channels, int threads,
                         bool repeats = true);

// Leaps from the voxels themselves, by the exact rule for trilinear lookups.
LeapGrid leaps_of_voxels(const CloudMedium& medium, int cell, int threads);

}  // namespace skybake
