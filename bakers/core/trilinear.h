// The lookup that a runtime makes of a volume: trilinear between voxel centres, repeated.
#pragma once

#include <array>

namespace skybake {

// A voxel and its weight.
struct VoxelTap {
    std::array<int, 3> voxel{};
    double weight = 0;
};

// The eight taps of a lookup at texture coordinates `uvw` (any finite numbers; voxel i of an axis
// has its centre at (i + 1/2) / size), x fastest. Their weights sum to 1; voxels beyond the
// volume's edge are those of its next copy, so that one may come twice in small volumes.
std::array<VoxelTap, 8> trilinear_taps(const std::array<int, 3>& size,
                                       const std::array<double, 3>& uvw);

}  // namespace skybake
