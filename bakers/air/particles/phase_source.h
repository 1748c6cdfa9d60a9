// The phase functions that an asset asks for, one per channel: the functions themselves and fine
// tables of them.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bakers/air/particles/phase_function.h"
#include "bakers/math/facts.h"
#include "config/assets/phase.h"
#include "config/sections/parameters.h"

namespace skybake {

struct PhaseSource {
    std::vector<PhaseFunction> functions;                       // one per wavelength
    std::vector<std::shared_ptr<const TabulatedPhase>> tables;  // to be inverted
    Facts facts;                                                // cross-sections, for particles
    std::string text;                                           // "particles fog", "layer mie"
    double error = 0;  // relative, of the functions themselves: error of the averages over sizes
};

// Returns the phase functions of particles, or of a layer of the atmosphere.
PhaseSource phase_source(const config::Parameters& parameters, const config::PhaseBake& bake,
                         int threads);

}  // namespace skybake
