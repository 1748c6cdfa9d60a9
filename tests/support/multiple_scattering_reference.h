// Hillaire's multiple scattering by nested adaptive quadrature of the definition: for tests,
// seconds a point. It shares with the kernel the medium and the geometry of rays.
#pragma once

#include "bakers/air/medium.h"

namespace skybake {

struct MultipleScatteringTerms {
    Spectrum second_order{};  // L_2nd, 1/sr
    Spectrum scattered{};     // f
    Spectrum escape{};        // 1 - f
    Spectrum psi{};           // L_2nd / (1 - f), 1/sr
};

// Each nested integral is halved until two rules agree within `relative`.
MultipleScatteringTerms reference_multiple_scattering(const Medium& medium, double altitude_km,
                                                      double sun_cos_zenith,
                                                      double relative = 1e-5);

}  // namespace skybake
