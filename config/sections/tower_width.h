// How narrow a tower is on a grid of voxels.
#pragma once

#include <array>

#include "config/sections/cloud.h"

namespace skybake::config {

// The standard deviation of the tower's Gaussian in its narrowest direction over the ground plan,
// in voxels of a volume that has so many along x and y.
//
//   C = S R A R^T S,  A = [s0^2, r s0 s1; r s0 s1, s1^2]
//
// with R the rotation, r the correlation, S the voxels a tile: the lesser root of C's
// characteristic polynomial is the variance sought. An axis of one voxel has no direction.
double narrowest_sigma(const Tower& tower, const std::array<int, 3>& size);

// The same of the narrowest tower that a scatter may make, whatever its rotation.
double narrowest_sigma(const TowerScatter& scatter, const std::array<int, 3>& size);

}  // namespace skybake::config
