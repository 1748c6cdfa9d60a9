// The extremes of the trilinear filter over one cell where double is not wide enough for them.
#pragma once

#include "bakers/occupancy/cell_row_kernel.h"

namespace skybake::occupancy {

// The extremes over cell `k` of a bundle, rounded outwards, from those that trilinear_row found in
// double, whose sums may have been rounded. Exact for any finite floats.
struct CellExtremes {
    float least = 0;
    float most = 0;
};
CellExtremes exact_extremes(const RowBundle& bundle, int k, double least, double most);

}  // namespace skybake::occupancy
