// The exact Euclidean distance from the texels of a grid to the nearest cells of a kind, of a volume
// whose voxels may have edges of three lengths.
//
// The square of the distance from a point to a box is the sum of the squares along the three axes,
// so that the least over all boxes is found axis by axis:
//   min over k of ( z(k)^2 + min over j of ( y(j)^2 + min over i of x(i)^2 ) ),
// where i, j, k run over the cells of a kind and x(i) is the distance from the point to cell i along
// x. This is the transform of P. Felzenszwalb and D. Huttenlocher, "Distance transforms of sampled
// functions", 2012, and of A. Meijster et al., "A general algorithm for computing distance
// transforms in linear time", 2000, with boxes in the place of points.
//   along x    the nearest cells on either side are looked up in the bits of the row.
//   along y,z  for a point that moves upwards, the cell with the least sum never moves downwards,
//              since the squared distances to two boxes that do not overlap differ by a function
//              that never decreases. So the best cells of every second point bound those of the
//              points between them: log2(n) rounds, each over all cells about once. A vector holds
//              columns side by side.
#pragma once

#include <array>
#include <functional>

#include "bakers/math/bake_options.h"
#include "bakers/math/memory.h"
#include "bakers/occupancy/cell_grid.h"
#include "bakers/occupancy/cloud_bits.h"

namespace skybake::occupancy {

// The texels of a distance grid are the cells of grid.cell voxels. The distance is taken from their
// centres. Texels repeat along x and y, where grid.cell divides the voxels.
struct DistanceGrid {
    CellGrid grid;
    std::array<double, 3> voxel_m{};  // edges of a voxel, > 0
};

// Takes the squared distances, in m^2, of the texels x to x + count - 1 of a row. Called once for
// each texel, on several threads. Infinite: there is no such cell.
using TexelSquares = std::function<void(int x, int y, int z, int count, const float* squares)>;

// Squares are sums of three floats, each the square of a multiple of half a voxel: they are exact
// where these are, and off by 2^-20 of themselves at most otherwise. Holed cells lie beyond the base
// and the top of the volume, too, so that their distance is finite. The result does not depend on
// the number of threads or on the width of vectors; it is incomplete once options.progress is
// cancelled. Memory, which `scratch` keeps for another call: a float for each texel of a plane times
// each voxel along z.
void distance_squares(const VoxelBits& bits, const DistanceGrid& grid, CellKind kind,
                      const BakeOptions& options, ScratchFloats& scratch, const TexelSquares& take);

}  // namespace skybake::occupancy
