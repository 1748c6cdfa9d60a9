// Phase functions and their Legendre moments. All of the recipe's closed phase functions have one
// form:
//
//   p(nu) = (a + b nu^2) / (1 + g^2 - 2 g nu)^(3/2)     [1/sr], the integral over directions is 1
//
// nu is the cosine of the angle between the incoming and outgoing direction.
//
//   isotropic            a = 1 / 4 pi
//   Rayleigh             a = b = 3 / 16 pi
//   Henyey-Greenstein    a = (1 - g^2) / 4 pi                              Henyey & Greenstein 1941
//   Cornette-Shanks      a = b = 3 (1 - g^2) / (8 pi (2 + g^2))            Cornette & Shanks 1992
//
// The denominator is computed as (1 - |g|)^2 + 2 |g| (1 -+ nu): the sum 1 + g^2 - 2 g nu loses all
// digits where g is near 1 and the light goes on almost straight. Spheres have a table instead.
#pragma once

#include <memory>
#include <vector>

#include "bakers/air/particles/tabulated_phase.h"
#include "config/sections/forward.h"

namespace skybake {

struct PhaseFunction {
    double constant = 0;                                    // a
    double quadratic = 0;                                   // b
    double g = 0;                                           // in (-1, 1)
    std::shared_ptr<const TabulatedPhase> table = nullptr;  // if there is one, the rest is unused
    bool operator==(const PhaseFunction&) const = default;
};

// Makes a phase function of a closed form: `phase` must not be mie.
PhaseFunction make_phase_function(config::Phase phase, double g);

// Makes Rayleigh's phase function of molecules that are no spheres, which depolarise the share
// `depolarization` of light scattered by 90 degrees (Bates 1984, Bucholtz 1995):
//
//   a = 3 (1 + 3 gamma) / (16 pi (1 + 2 gamma)),  b = 3 (1 - gamma) / (16 pi (1 + 2 gamma)),
//   gamma = rho / (2 - rho)
PhaseFunction make_rayleigh_phase(double depolarization);

// Returns p in 1/sr for the cosine nu, given as 1 - nu and 1 + nu.
double phase_value(const PhaseFunction& phase, double one_minus_cosine, double one_plus_cosine);

// Forms that are fitted to a phase function, in 1/sr. Draine's (Draine 2003) is Henyey-Greenstein's
// for alpha = 0 and Cornette-Shanks's for alpha = 1. They do not use phase_value and
// make_phase_function, which round differently: fits would change in their last digits.
double henyey_greenstein(double g, double one_minus_cosine, double one_plus_cosine);
double draine(double g, double alpha, double one_minus_cosine, double one_plus_cosine);

// Returns Rayleigh's phase function of nu in 1/sr, written as in the lookups that runtimes multiply
// by it. It rounds differently from a + b nu^2.
double rayleigh_phase(double nu);

// --- Legendre moments ----------------------------------------------------------------------------

// The Legendre moments of a phase function:
//
//   chi_l = integral over directions of p(nu) P_l(nu),   p(nu) = 1/4pi sum (2 l + 1) chi_l P_l(nu)
//
// chi_0 = 1, and chi_1 is the mean cosine. For Cornette-Shanks the mean cosine is not the parameter
// g but 3 g (4 + g^2) / (5 (2 + g^2)).
//
// Henyey-Greenstein's moments are g^l. Every closed form is Henyey-Greenstein's times (a + b nu^2),
// up to a constant factor, and nu^2 P_l is a sum of P_(l+2), P_l and P_(l-2).

// chi_0 .. chi_degree, in closed form or of a table.
std::vector<double> legendre_moments(const PhaseFunction& phase, int degree);

}  // namespace skybake
