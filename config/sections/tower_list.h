// Towers of clouds that are written as an array of tables.
#pragma once

#include "config/text/value_tree.h"

namespace skybake::config {

// Makes every array [[clouds.NAME.towers]] of a source the table of its items, named "0", "1" and
// so on, so that a key of one tower has a path. As arrays do, it replaces the towers of earlier
// sources.
void name_listed_towers(Table& root);

// The same for the keys of one cloud.
void name_listed_towers_of_cloud(Table& cloud);

// The towers in the order in which they are summed: names that are whole numbers by their value,
// and then the others by name.
std::vector<const Entry*> towers_in_order(const Table& towers);

}  // namespace skybake::config
