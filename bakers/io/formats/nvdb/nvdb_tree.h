// The tree of a NanoVDB grid without its voxels: where each leaf is in the file, and the values of
// tiles.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bakers/io/formats/nvdb/nvdb_input.h"

namespace skybake {

// A leaf, or a cube of one value.
struct NvdbCube {
    std::array<int, 3> corner{};
    float value = 0;         // of a tile
    std::uint64_t leaf = 0;  // offset in the file; 0: a tile
};

struct NvdbTree {
    // Throws NvdbDamage where a node lies beyond the grid, is listed twice or is not in its place.
    // Memory use is 24 bytes for each leaf and for each tile that is not the background, of which the
    // file itself has at least 8.
    NvdbTree(NvdbInput& file, const NvdbGrid& grid);

    // Returns what holds the voxels of the leaf's cube with this corner, or null: the background.
    const NvdbCube* find(const std::array<int, 3>& corner) const;

    // Leaves and tiles in order of their corners, with edges of 8, 128 and 4096 voxels.
    std::array<std::vector<NvdbCube>, 3> cubes;
    float background = 0;
    // The smallest and largest value of tiles and background.
    float least_tile = 0;
    float largest_tile = 0;
    bool has_finite_tiles = true;
    // The least and the greatest index of an active voxel, as the root says. Greatest below least: none
    // is active.
    std::array<int, 3> first{};
    std::array<int, 3> last{};
};

}  // namespace skybake
