// The empty-space skip distance: how far a ray may skip from an empty cell. Its channel is called
// `leap`.
#pragma once

#include <cstdint>
#include <vector>

#include "bakers/occupancy/occupied_cells.h"

namespace skybake::occupancy {

// Returns for each cell, x fastest, the Chebyshev distance in cells to the nearest occupied one: 0
// in occupied cells, 1 beside them. All cells within distance - 1 cells are empty. Distances wrap
// around along x and y, not along z. 255 stands for 255 and more, and for no occupied cell at all.
//
// The time is linear in the number of cells, except for a factor log2(min(size_x / 2, 255)) in the
// first of three passes. Each pass is exact. Let a field be 1-Lipschitz if neighbours differ by at
// most 1.
//   along x  min over x' of |x - x'|, wrapped, where x' is occupied in the row, by doubling steps:
//            after steps 1, 2, 4, ... 2^m any path of up to 2^(m + 1) - 1 cells is the sum of some.
//   along y  d(x, y) = min(d(x, y), 1 + the least of d(x - 1 ... x + 1, y -+ 1)), upwards, then
//            downwards, each going on around the tile until a row does not change.
//   along z  d(x, y, z) = min(d(x, y, z), 1 + the least of the 3 x 3 of plane z -+ 1), upwards,
//            then downwards.
// Proof. Every value is the length of some path to an occupied cell, so it is never too small. Take
// a shortest path of n steps between cells that are dx, dy, dz apart, n = max(|dx|, |dy|, |dz|).
// Its steps can be ordered so that it first goes |dx| - max(|dy|, |dz|) steps along x alone, if
// that is positive, then max(|dy|, |dz|) - |dz| steps along y, each combined with a step along x if
// one is left, then |dz| steps along z, combined with steps along x and y as they are left, each
// coordinate in one direction only. The passes follow the path in this order, and none needs those
// before it again: the 3 (or 3 x 3) least of a 1-Lipschitz field, plus 1, and the lesser of two
// such fields are themselves 1-Lipschitz along x (and y), so that further steps along x alone
// change nothing. In the second round along y a row depends only on the row before: where that has
// not changed, nothing after it changes.
std::vector<std::uint8_t> leap_distance(const OccupiedCells& cells);

}  // namespace skybake::occupancy
