// A cloud volume as rays see it: what a lookup returns, which extinction that means, and how far a
// ray may leap through empty space (the empty-space skip distance).
//
// Positions are in voxel units: voxel i of an axis has its centre at i + 1/2. The volume either
// repeats along x and y or has empty space beside it. Along z lookups are clamped, and space below
// 0 and above size[2] is empty.
//
// Blocks of voxels that divide a volume evenly.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "bakers/air/cloud_phase.h"
#include "bakers/math/memory.h"
#include "config/sections/cloud.h"

namespace skybake {

// Voxels with one more on each side, so that no lookup needs to wrap or clamp. Along x and y, the
// padding is the next tile, or 0 if the volume does not repeat. Along z, it repeats the outermost
// voxels.
struct PaddedVolume {
    std::array<int, 3> size{};  // without the padding
    AlignedFloats values;       // (size + 2)^3, x fastest

    std::ptrdiff_t row() const { return size[0] + 2; }
    std::ptrdiff_t plane() const { return row() * (size[1] + 2); }
};

// Pads channel number `channel` of `channels` interleaved channels. There may be at most 2^31 - 1
// padded voxels.
PaddedVolume padded_volume(const float* voxels, const std::array<int, 3>& size, int channel,
                           int channels, int threads, bool repeats = true);

// How far a ray may leap. Everything within `reach` voxels of an empty cell's faces is empty; the
// reach of an occupied cell is -1.
struct LeapGrid {
    int cell = 1;  // voxels along each edge, a power of two
    std::array<int, 3> cells{};
    std::vector<float> reach;  // x fastest
};

// `leaps` are Chebyshev distances in cells to the nearest occupied one (leap_distance.h), 0 in
// occupied cells. A cell with a leap of L has L - 1 empty cells on each side. They are (L - 1) *
// cell voxels, minus what the tile's last cells lack if `cell` does not divide the size: at most
// one such cell per tile.
LeapGrid leap_grid(const std::array<int, 3>& voxels, int cell, const std::vector<float>& leaps);

// How the copies of a repeating tile differ, so that no pattern shows towards the horizon: each copy
// reads the volume from another voxel on. Copies run into each other over a margin on both sides of
// their common border (tile_variation-inl.h). `shift_x` and `shift_y` hold the first voxel that a copy
// reads, for kVariedTiles x kVariedTiles copies; copies beyond repeat these. The first copy begins at
// voxel 0, so that what a recipe places is there.
inline constexpr int kVariedTiles = 64;
struct TileVariation {
    std::vector<float> shift_x;  // voxels, integers; empty: all copies are alike
    std::vector<float> shift_y;
    float margin_x = 0;  // voxels
    float margin_y = 0;
    float greatest = 0;  // magnitude of a voxel

    bool varies() const { return !shift_x.empty(); }
};

struct CloudMedium {
    std::array<double, 3> extent_m{};  // the tile's edges along x and y, and the layer's height
    double base_m = 0;                 // altitude of z = 0
    bool repeats = true;               // along x and y
    CloudOptics optics;
    PaddedVolume volume;
    // A lookup in float is cloud if it is above this. It exceeds the threshold by 2^-20 of the
    // greatest magnitude of a voxel, so that rounding never makes cloud of what exact arithmetic
    // calls empty: a trilinear lookup in float is three nested interpolations a + t (b - a), each
    // with an error of at most 5 units of 2^-24, which together are less than that margin. If the
    // threshold is 0 and no voxel is negative, this is 0, because sums and products of zeros are
    // exact.
    float visible_above = 0;
    LeapGrid leaps;
    TileVariation variation;

    double meters_per_voxel(std::size_t axis) const { return extent_m[axis] / volume.size[axis]; }
};

// Makes a medium without leaps: all its cells count as occupied. The leaps of a repeating volume
// are also valid for the same volume without repetition, which contains less cloud.
CloudMedium cloud_medium(const Cloud& cloud, const float* voxels, const std::array<int, 3>& size,
                         int channels, int threads, bool repeats = true);

// Returns the medium of the mean densities of blocks of at most so many voxels along x, y and z, which divide the
// volume evenly. It has no edge and no leaps.
CloudMedium coarse_medium(const CloudMedium& medium, const std::array<int, 3>& block, int threads);

// Returns a variation of the medium's tiles. The same size of the volume gives the same shifts.
TileVariation varied_tiles(const CloudMedium& medium);

// Calculates leaps from the voxels, by the exact rule for trilinear lookups.
LeapGrid leaps_of_voxels(const CloudMedium& medium, int cell, int threads);

// A grid of blocks of at most `block` voxels. Block k of an axis has the voxels
// floor(k N / n) ... floor((k + 1) N / n) - 1.
struct VoxelBlocks {
    std::array<int, 3> voxels{};
    std::array<int, 3> size{};

    VoxelBlocks(const std::array<int, 3>& voxels_, const std::array<int, 3>& block)
        : voxels(voxels_) {
        for (std::size_t a = 0; a < 3; ++a) size[a] = (voxels[a] + block[a] - 1) / block[a];
    }
    int first(std::size_t axis, int k) const {
        return static_cast<int>(std::int64_t{k} * voxels[axis] / size[axis]);
    }
    std::size_t plane_count() const {
        return static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]);
    }
};

// Returns the mean density of the voxels of a block.
double mean_density(const CloudMedium& medium, const VoxelBlocks& blocks, int i, int j, int k);

}  // namespace skybake
