// How layers scatter by angle, in one form that all of the recipe's closed phase functions have:
//
//   p(nu) = (a + b nu^2) / (1 + g^2 - 2 g nu)^(3/2)     [1/sr], the integral over directions is 1
//
// nu is the cosine between the light's way before and after.
//
//   isotropic            a = 1 / 4 pi
//   Rayleigh             a = b = 3 / 16 pi
//   Henyey-Greenstein    a = (1 - g^2) / 4 pi                              Henyey & Greenstein 1941
//   Cornette-Shanks      a = b = 3 (1 - g^2) / (8 pi (2 + g^2))            Cornette & Shanks 1992
//
// The denominator is (1 - |g|)^2 + 2 |g| (1 -+ nu): the sum 1 + g^2 - 2 g nu loses all digits where
// g is near 1 and the light goes on almost straight. Spheres have a table in its place.
#pragma once

#include <memory>
#include <vector>

#include "bakers/air/particles/tabulated_phase.h"
#include "config/sections/atmosphere.h"

namespace skybake {

struct PhaseFunction {
    double constant = 0;                                    // a
    double quadratic = 0;                                   // b
    double g = 0;                                           // in (-1, 1)
    std::shared_ptr<const TabulatedPhase> table = nullptr;  // if there is one, the rest is unused
    bool operator==(const PhaseFunction&) const = default;
};

// Of a closed form: not of mie.
PhaseFunction make_phase_function(config::Phase phase, double g);

// p at nu = cosine, told by 1 - nu and 1 + nu.
double phase_value(const PhaseFunction& phase, double one_minus_cosine, double one_plus_cosine);

// Forms that are fitted to a phase function, in 1/sr; alpha 0 of Draine's is Henyey-Greenstein's, 1
// Cornette-Shanks' (Draine 2003). They are not phase_value of make_phase_function's numbers, since
// these round differently, and fits would change in their last digits.
double henyey_greenstein(double g, double one_minus_cosine, double one_plus_cosine);
double draine(double g, double alpha, double one_minus_cosine, double one_plus_cosine);

// Rayleigh's of nu, in 1/sr, in the words of the lookups by which runtimes multiply. It rounds
// otherwise than a + b nu^2.
double rayleigh_phase(double nu);

// --- Legendre moments ----------------------------------------------------------------------------

// The Legendre moments of a phase function:
//
//   chi_l = integral over directions of p(nu) P_l(nu),   p(nu) = 1/4pi sum (2 l + 1) chi_l P_l(nu)
//
// chi_0 = 1 and chi_1 is the mean cosine, which for Cornette-Shanks is not its parameter g but
// 3 g (4 + g^2) / (5 (2 + g^2)).

// chi_0 .. chi_degree, in closed form or of a table.
//
// Henyey-Greenstein's are g^l. The forms of phase_function.h are Henyey-Greenstein's times
// (a + b nu^2), and nu^2 P_l is a sum of P_(l+2), P_l and P_(l-2).
std::vector<double> legendre_moments(const PhaseFunction& phase, int degree);

}  // namespace skybake
