// How far a ray may leap from an empty cell.
#pragma once

#include <cstdint>
#include <vector>

#include "bakers/occupancy/occupied_cells.h"

namespace skybake::occupancy {

// Per cell, x fastest, the Chebyshev distance in cells to the nearest occupied one: 0 in occupied
// cells, 1 beside them. Everything within distance - 1 cells is empty. It wraps around along x and
// y, not along z; 255 stands for 255 and more, and for none at all.
//
// In time linear in the number of cells but for a factor log2(min(size_x / 2, 255)) in the first of
// three passes, each exact. Let a field be 1-Lipschitz if neighbours differ by at most 1.
//   along x  min over x' of |x - x'|, wrapped, where x' is occupied in the row, by doubling steps:
//            after steps 1, 2, 4, ... 2^m any way of up to 2^(m + 1) - 1 cells is the sum of some.
//   along y  d(x, y) = min(d(x, y), 1 + the least of d(x - 1 ... x + 1, y -+ 1)), upwards, then
//            downwards, each going on around the tile until a row does not change.
//   along z  d(x, y, z) = min(d(x, y, z), 1 + the least of the 3 x 3 of plane z -+ 1), upwards,
//            then downwards.
// Proof. Every value is the length of some way to an occupied cell, so never too small. A shortest
// way of n steps between cells dx, dy, dz apart, n = max(|dx|, |dy|, |dz|), can be ordered to first
// go |dx| - max(|dy|, |dz|) steps along x alone, if that is positive, then max(|dy|, |dz|) - |dz|
// steps along y, each with a step along x if one is left, then |dz| steps along z with steps along
// x and y as they are left, each coordinate in one direction only. The passes follow it in this
// order, and none needs those before it again: the 3 (or 3 x 3) least of a 1-Lipschitz field, plus
// 1, and the lesser of two such fields, are 1-Lipschitz along x (and y) themselves, so that further
// steps along x alone change nothing. A row of y's second time around depends on the row before
// alone: where that has not changed, nothing after it does.
std::vector<std::uint8_t> leap_distance(const OccupiedCells& cells);

// The same by looking from each cell at every occupied one: for tests.
std::vector<std::uint8_t> leap_distance_reference(const OccupiedCells& cells);

}  // namespace skybake::occupancy
