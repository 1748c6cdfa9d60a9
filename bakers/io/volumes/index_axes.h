// Grids whose index axes do not run along x, y and z of the file's space: turned by right angles or
// mirrored, as programs with y up export them. Their voxels are permuted, not interpolated.
//
// Along the space's axes, voxel j of an axis on which indices fall is index -j of the grid, so that
// both have the same centre.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "bakers/io/volumes/file_voxels.h"

namespace skybake {

struct IndexAxes {
    // For each axis of space: the axis of indices along it, and whether indices fall as it rises.
    std::array<std::size_t, 3> index{0, 1, 2};
    std::array<bool, 3> falls{};

    bool are_plain() const { return *this == IndexAxes{}; }
    bool operator==(const IndexAxes&) const = default;
};

// Where an affine map sends indices: steps[i] from voxel to voxel along index axis i, and the centre
// of voxel (0, 0, 0).
struct IndexMap {
    std::array<std::array<double, 3>, 3> steps{};
    std::array<double, 3> centre{};
};

// Fills in the edges of a voxel and the corner of voxel (0, 0, 0), and the axes. Returns what is wrong
// with the map, in words, or none.
std::optional<std::string> read_index_map(const IndexMap& map, FileVoxels& voxels, IndexAxes& axes);

// Turns a file's box and voxels from the axes of its indices to those of its space.
void turn_to_space(const IndexAxes& axes, FileVoxels& voxels);

}  // namespace skybake
