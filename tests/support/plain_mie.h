// The series of one sphere at a time in plain double (lorenz_mie.h), which the kernel must equal bit for
// bit on every instruction set.
#pragma once

#include <vector>

#include "bakers/air/particles/lorenz_mie.h"

namespace skybake {

struct MieCoefficients {
    double size_parameter = 0;
    std::vector<ComplexNumber> a, b;   // a_1 ..., b_1 ...
    double absorption_efficiency = 0;  // Q_abs
};

// Computes the coefficients for 1e-8 <= x <= 3e5 and 0.01 <= |m| <= 150. Time and memory grow as
// max(1, |m|) x.
MieCoefficients mie_coefficients(double size_parameter, ComplexNumber refractive_index);

MieEfficiencies mie_efficiencies(const MieCoefficients& coefficients);

MieTerms mie_terms(const MieCoefficients& coefficients);

}  // namespace skybake
