// Gauss-Legendre quadrature on [0, 1].
#pragma once

#include <array>
#include <vector>

namespace skybake {

struct QuadratureRule {
    std::vector<double> nodes;    // ascending, in (0, 1)
    std::vector<double> weights;  // positive, their sum is 1
};

// The rule with `count` >= 1 nodes: exact for polynomials up to degree 2 count - 1. Nodes and
// weights within 1e-15, the same bits everywhere.
QuadratureRule gauss_legendre(int count);

}  // namespace skybake
