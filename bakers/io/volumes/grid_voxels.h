// Boxes of voxels as the leaves and nodes of OpenVDB's and NanoVDB's trees divide them.
//
// Converts the numbers of a grid to densities.
//
// The numbers of a fog volume are densities. Those of a level set are signed distances to a surface,
// negative inside of it, which are only known within a narrow band; deeper inside they are all minus
// the half width w of the band. Density falls from 1 there to 0 at the surface:
//
//   density(s) = clamp(-s / w, 0, 1)
//
// as OpenVDB's tools::sdfToFogVolume has it, but for the rounding of its product by 1 / w.
// Distances and w are in the same unit, so that the density does not depend on the unit, nor on a
// `voxel_size` of the recipe.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "bakers/field/level.h"
#include "bakers/field/voxel_index.h"
#include "bakers/io/volumes/file_voxels.h"

namespace skybake {

// Calls visit(part) with the part of a box in each cube of `edge` voxels that it reaches, until it
// returns false. Cubes begin at multiples of their edge, a power of two.
template <class Visit>
void for_cubes(const VoxelBox& box, int edge, const Visit& visit) {
    std::array<std::vector<std::array<int, 2>>, 3> runs;  // first voxel and number of voxels
    for (std::size_t i = 0; i < 3; ++i) {
        const int end = box.origin[i] + box.size[i];
        for (int at = box.origin[i]; at < end;) {
            const int next = std::min((at & ~(edge - 1)) + edge, end);
            runs[i].push_back({at, next - at});
            at = next;
        }
    }
    for (const auto& z : runs[2]) {
        for (const auto& y : runs[1]) {
            for (const auto& x : runs[0]) {
                if (!visit(VoxelBox{{x[0], y[0], z[0]}, {x[1], y[1], z[1]}})) return;
            }
        }
    }
}

// Copies the part of a leaf to its place in a box. `value_at` returns the value at an offset, at which
// z runs fastest, then y, then x.
template <class ValueAt>
void copy_leaf(const VoxelBox& part, const VoxelBox& box, const ValueAt& value_at, float* out) {
    const auto offset = [](int x, int y, int z) {
        return static_cast<std::size_t>((x & 7) << 6 | (y & 7) << 3 | (z & 7));
    };
    for (int z = part.origin[2]; z < part.origin[2] + part.size[2]; ++z) {
        for (int y = part.origin[1]; y < part.origin[1] + part.size[1]; ++y) {
            float* to = out + index_in(box, {part.origin[0], y, z});
            for (int x = part.origin[0]; x < part.origin[0] + part.size[0]; ++x) {
                *to++ = value_at(offset(x, y, z));
            }
        }
    }
}

// The values of a leaf in the order of its offsets.
using LeafValues = std::array<float, 512>;

class DensityRamp {
  public:
    // Numbers are densities.
    DensityRamp() = default;
    // Numbers are distances. half_width is valid if it is finite and above 0.
    explicit DensityRamp(float half_width) : half_width_(half_width), changes_(true) {}

    bool is_valid() const { return !changes_ || (std::isfinite(half_width_) && half_width_ > 0); }
    bool changes() const { return changes_; }
    float operator()(float number) const {
        if (!changes_) return number;
        return number < 0 ? std::min(1.0F, -number / half_width_) : 0.0F;
    }

  private:
    float half_width_ = 0;
    bool changes_ = false;
};

// Makes densities of a leaf's numbers. Those that are not finite are taken for the background.
inline void make_densities(const DensityRamp& density, float background, LeafValues& values) {
    for (float& value : values) value = density(std::isfinite(value) ? value : background);
}

// Makes densities of the numbers of a leaf at a corner, and counts their faults and the largest one.
// Returns whether all of them are 0.
inline bool survey_leaf(const std::array<int, 3>& corner, const DensityRamp& density,
                        float background, LeafValues& values, FileVoxels& voxels) {
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!ValueFaults::is_fault(values[i]) || values[i] == background) continue;
        const auto offset = static_cast<std::int64_t>(i);
        voxels.faults.add(values[i], {corner[0] + (offset >> 6), corner[1] + (offset >> 3 & 7),
                                      corner[2] + (offset & 7)});
    }
    make_densities(density, background, values);
    voxels.largest = std::max(voxels.largest, *std::ranges::max_element(values));
    return std::ranges::all_of(values, [](float value) { return value == 0; });
}

}  // namespace skybake
