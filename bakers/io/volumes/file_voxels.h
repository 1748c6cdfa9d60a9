// Voxels of a volume's files, whatever the format, along the axes of the file's space.
//
// Values of a volume that are no densities, counted while the volume is read.
//
// Grids whose index axes do not run along x, y and z of the file's space: turned by right angles or
// mirrored, as programs with y up export them. Their voxels are permuted, not interpolated.
//
// Along the space's axes, voxel j of an axis on which indices fall is index -j of the grid, so that
// both have the same centre.
//
// Finds the grid of a file that a recipe means.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bakers/field/level.h"

namespace skybake {

struct ValueFaults {
    struct Kind {
        std::int64_t count = 0;               // voxels
        std::array<std::int64_t, 3> index{};  // of the first one
        float value = 0;                      // there
        float least = 0;                      // of all; NaN does not count
        void add(float found, const std::array<std::int64_t, 3>& at, std::int64_t voxels) {
            if (count == 0) {
                index = at;
                value = found;
            }
            count += voxels;
            if (found < least) least = found;
        }
    };
    Kind not_finite;
    Kind negative;

    static bool is_fault(float value) { return !(value >= 0) || std::isinf(value); }
    void add(float value, const std::array<std::int64_t, 3>& index, std::int64_t voxels = 1) {
        if (!std::isfinite(value)) {
            not_finite.add(value, index, voxels);
        } else if (value < 0) {
            negative.add(value, index, voxels);
        }
    }
};

// "its voxel (3, 0, 5) is nan, the first of 12 that are not finite". Indices are the file's own.
std::string words_of_fault(const ValueFaults::Kind& kind, const char* what);

// The same for values that are not finite, with the key that takes the background for them.
std::string refusal_of(const ValueFaults& faults);

struct FileVoxels {
    std::array<int, 3> first{};            // index of the first voxel
    std::array<int, 3> size{};             // from there
    std::array<double, 3> voxel_size{};    // edges, in the file's units; 0 if it does not say
    std::array<double, 3> index_origin{};  // lower corner of voxel (0, 0, 0) in the file's space
    bool has_place = false;                // the file says where in space it lies
    ValueFaults faults;                    // if the voxels were asked for
    float background = 0;
    float largest = 0;  // no value is above it, `background` included
    // One channel, by index. A box may reach beyond the voxels, where there is background. Null if
    // only the shape was asked for. It throws if the file changes while it is read.
    std::shared_ptr<const VoxelSource> voxels;
};

// What is asked for of a file: the shape alone; voxels that are densities; or its numbers as they are,
// also those of level sets and those that are not finite, with neither faults nor `largest`. The box
// of numbers may be empty.
enum class VolumePart { shape, voxels, numbers };

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

struct GridName {
    std::string name;
    bool is_of_numbers = true;
};

// Finds the grid of a name. Without a name it is `density` or the only grid of numbers. Returns why
// there is none, in words, with what the recipe may say.
std::optional<std::string> find_grid_name(const std::vector<GridName>& grids,
                                          const std::string& asked, std::size_t& number);

}  // namespace skybake
