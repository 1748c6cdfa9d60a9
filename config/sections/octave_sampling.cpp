#include "config/sections/octave_sampling.h"

#include <cstdint>

namespace skybake::config {
namespace {

bool at_corners(std::size_t axis, NoiseSampling sampling) {
    return sampling == NoiseSampling::corners ||
           (sampling == NoiseSampling::slices_at_corners && axis == 2);
}

// (2i + 1) f / 2N is an integer for all i if it is one for i = 0; i f / N if it is one for i = 1. A
// single voxel at a corner lies at 0, and 1 divides f.
bool meets_only_lattice_points(int frequency, int size, bool corners) {
    const std::int64_t denominator = std::int64_t{corners ? 1 : 2} * size;
    return frequency % denominator == 0;
}

}  // namespace

bool is_coarse(const std::array<int, 3>& frequency, const std::array<int, 3>& size) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::int64_t wanted = std::int64_t{fewest_voxels_per_cell} * frequency[axis];
        if (size[axis] > 1 && size[axis] < wanted) return true;
    }
    return false;
}

bool is_zero_everywhere(const std::array<int, 3>& frequency, const std::array<int, 3>& size,
                        NoiseSampling sampling) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const bool corners = at_corners(axis, sampling);
        if (!meets_only_lattice_points(frequency[axis], size[axis], corners)) return false;
    }
    return true;
}

}  // namespace skybake::config
