// The towers of a cloud: lists read from files, and how wide a tower is.
#pragma once

#include <array>

#include "config/sections/cloud.h"
#include "config/text/value_tree.h"

namespace skybake::config {

// Towers of clouds that are written as an array of tables.

// Makes every array [[clouds.NAME.towers]] of a source the table of its items, named "0", "1" and
// so on, so that a key of one tower has a path. As arrays do, it replaces the towers of earlier
// sources.
void name_listed_towers(Table& root);

// The same for the keys of one cloud.
void name_listed_towers_of_cloud(Table& cloud);

// The towers in the order in which they are summed: names that are whole numbers by their value,
// and then the others by name.
std::vector<const Entry*> towers_in_order(const Table& towers);

// How narrow a tower is on a grid of voxels.

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
