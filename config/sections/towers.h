// This header names the towers that a cloud lists, sorts them, and says how narrow a tower is.
#pragma once

#include <array>

#include "config/fields/section_decoder.h"
#include "config/sections/cloud.h"
#include "config/text/value_tree.h"

namespace skybake::config {

// Turns every array [[clouds.NAME.towers]] of a source into a table of its items, which are named
// "0", "1" and so on. So a key of one tower has a path. The table replaces the towers of earlier
// sources, as arrays do.
void name_listed_towers(Table& root);

// Does the same for the keys of one cloud.
void name_listed_towers_of_cloud(Table& cloud);

// Returns the towers in the order in which they are summed. Towers whose names are whole numbers
// come first, sorted by number, and then the others, sorted by name.
std::vector<const Entry*> towers_in_order(const Table& towers);

// Reports lives of towers that do not fit into a loop, and drifts after which standing towers are not
// where they were (E0182).
void check_life(const DecodedSection& section, const TowerLife& tower, const Cloud& cloud,
                Decoder& decoder);

// Returns the standard deviation of the tower's Gaussian in its narrowest direction over the ground
// plan, in voxels of a volume with `size` voxels.
//
//   C = S R A R^T S,  A = [s0^2, r s0 s1; r s0 s1, s1^2]
//
// Here R is the rotation, r is the correlation, and S is the number of voxels per tile. The
// variance sought is the lesser root of C's characteristic polynomial. An axis of one voxel does
// not count as a direction.
double narrowest_sigma(const Tower& tower, const std::array<int, 3>& size);

}  // namespace skybake::config
