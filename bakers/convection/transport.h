// Advects fields: fluxes through the faces of cells, of fifth order along each axis.
//
// A flux takes the sixth-order mean of its face's neighbours less a share of their fifth difference, which
// damps what the grid cannot hold and nothing else (Wicker and Skamarock 2002, "Time-splitting methods for
// elastic models using forward time schemes", equations 4 to 6), or for heat and water, where these would
// overshoot at the edges of clouds, the weighted mean of three parabolas (Borges et al. 2008, "An improved
// weighted essentially non-oscillatory scheme"). What leaves a cell enters its neighbour, so that totals
// stay.
#pragma once

#include "bakers/convection/grid.h"

namespace skybake::convection {

enum class Flux { upwind, weighted };

struct Transport {
    const std::array<Field, 3>& velocity;
    const Field& from;  // its fluxes are taken
    const Field& base;  // what they are added to, times the step
    int shifted_axis =
        3;  // along which cells are moved to faces: 0, 1, 2; 3 for those of the centres
    Flux flux = Flux::upwind;
    float step_s = 0;
};

// Writes base + step times the tendency of `from` to levels first ... last - 1 of `to`.
void transport(const Grid& grid, const Transport& what, int first, int last, Field& to);

}  // namespace skybake::convection
