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

class NvdbTree {
  public:
    // Throws NvdbDamage where a node lies beyond the grid, is listed twice or is not in its place.
    // Memory use is 24 bytes for each leaf and for each tile that is not the background, of which the
    // file itself has at least 8.
    NvdbTree(NvdbInput& file, const NvdbGrid& grid);

    float background() const { return background_; }
    // The smallest and largest value of tiles and background.
    float least_tile() const { return least_tile_; }
    float largest_tile() const { return largest_tile_; }
    bool has_finite_tiles() const { return finite_tiles_; }
    // The least and the greatest index of an active voxel, as the root says. Greatest below least: none
    // is active.
    const std::array<int, 3>& first() const { return first_; }
    const std::array<int, 3>& last() const { return last_; }

    // The cubes of a leaf's size, leaves and tiles, in order of their corners.
    std::vector<NvdbCube>& leaf_cubes() { return cubes_[0]; }
    const std::vector<NvdbCube>& leaf_cubes() const { return cubes_[0]; }
    // Returns what holds the voxels of the leaf's cube with this corner, or null: the background.
    const NvdbCube* find(const std::array<int, 3>& corner) const;

  private:
    class Reader;

    std::array<std::vector<NvdbCube>, 3> cubes_;  // with edges of 8, 128 and 4096 voxels
    float background_ = 0;
    float least_tile_ = 0;
    float largest_tile_ = 0;
    bool finite_tiles_ = true;
    std::array<int, 3> first_{};
    std::array<int, 3> last_{};
};

}  // namespace skybake
