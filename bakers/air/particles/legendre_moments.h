// The Legendre moments of a phase function:
//
//   chi_l = integral over directions of p(nu) P_l(nu),   p(nu) = 1/4pi sum (2 l + 1) chi_l P_l(nu)
//
// chi_0 = 1 and chi_1 is the mean cosine, which for Cornette-Shanks is not its parameter g but
// 3 g (4 + g^2) / (5 (2 + g^2)).
#pragma once

#include <vector>

#include "bakers/air/particles/phase_function.h"

namespace skybake {

// chi_0 .. chi_degree, in closed form or of a table.
//
// Henyey-Greenstein's are g^l. The forms of phase_function.h are Henyey-Greenstein's times
// (a + b nu^2), and nu^2 P_l is a sum of P_(l+2), P_l and P_(l-2).
std::vector<double> legendre_moments(const PhaseFunction& phase, int degree);

}  // namespace skybake
