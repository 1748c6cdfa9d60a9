// Quadratures over the azimuth between view and sun, whose light is symmetric about 0.
#pragma once

namespace skybake {

struct AzimuthRule {
    int count = 0;
    double nodes[8] = {};
    double weights[8] = {};  // their sum is 1
};

// For the whole circle: nodes are cosines of the azimuths (i + 1/2) pi / n, n = 1, 2, 4 or 8, which
// integrate trigonometric polynomials up to degree 2 n - 1 exactly.
const AzimuthRule& full_circle_rule(int count);

// For azimuths from 0 to a bound: nodes are fractions of it. Gauss-Legendre with at least 4 nodes.
const AzimuthRule& lit_part_rule(int count);

}  // namespace skybake
