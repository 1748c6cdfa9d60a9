// The lookup that a runtime makes of a volume: trilinear between voxel centres.
#pragma once

#include <array>

namespace skybake {

// A voxel and its weight.
struct VoxelTap {
    std::array<int, 3> voxel{};
    double weight = 0;
};

// The eight taps of a lookup at texture coordinates `uvw` (any finite numbers; voxel i of an axis
// has its centre at (i + 1/2) / size), x fastest. Their weights sum to 1. Voxels beyond the
// volume's edge are those of its next copy along axes that repeat, else the last ones before it; so
// that one may come twice.
std::array<VoxelTap, 8> trilinear_taps(const std::array<int, 3>& size,
                                       const std::array<double, 3>& uvw,
                                       const std::array<bool, 3>& repeats = {true, true, true});

}  // namespace skybake
