// How a cloud scatters light: its phase function as a sum of closed forms, and the scaled cloud in which
// light that is scattered into the forward peak counts as not scattered.
//
// Light that is scattered often is the same, nearly, in a cloud with the extinction s sigma, the
// albedo w' and the moments chi'_l of the phase function (delta-M: Wiscombe 1977; similarity: van
// de Hulst 1980):
//
//   f = chi_(d+1)    s = 1 - w f    w' = w (1 - f) / s    chi'_l = (chi_l - f) / (1 - f), l <= d
//
// w is the albedo and d the degree of the harmonics. Light that is scattered once keeps the true phase
// function (Nakajima & Tanaka 1988).
#pragma once

#include <vector>

#include "bakers/air/cloud_phase.h"
#include "bakers/air/particles/phase_function.h"

namespace skybake::cloud_light {

// A share of the scattered light and its phase function.
struct ScatteringLobe {
    double share = 1;
    PhaseFunction phase;
};

struct CloudScattering {
    std::vector<ScatteringLobe> lobes;  // shares add up to 1
    double albedo = 1;                  // of single scattering
};

CloudScattering scattering_of(const CloudPhase& phase, double albedo);

// The phase function in 1/sr at a scattering angle, given as 1 - cosine and 1 + cosine.
double phase_value(const CloudScattering& scattering, double one_minus, double one_plus);

// The moments chi_0 ... chi_degree.
std::vector<double> moments_of(const CloudScattering& scattering, int degree);

struct ScaledScattering {
    double extinction_share = 1;   // s
    std::vector<double> returned;  // w' chi'_l, l = 0 ... degree
};
ScaledScattering scaled(const CloudScattering& scattering, int degree);

}  // namespace skybake::cloud_light
