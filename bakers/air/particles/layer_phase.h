// How a layer of the atmosphere scatters by angle: closed forms alike in all colour channels,
// spheres in each by its wavelength.
#pragma once

#include <cstddef>
#include <vector>

#include "bakers/air/particles/phase_function.h"
#include "bakers/math/vectors.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/atmosphere.h"
#include "config/sections/parameters.h"

namespace skybake {

struct LayerPhase {
    std::vector<PhaseFunction> functions;  // one for all channels, or one per channel

    bool is_alike() const { return functions.size() == 1; }
    const PhaseFunction& of(std::size_t channel) const {
        return functions[is_alike() ? 0 : channel];
    }
    bool operator==(const LayerPhase&) const = default;
};

LayerPhase layer_phase(const config::Layer& layer);

// p in each channel at nu = cosine, told by 1 - nu and 1 + nu.
Spectrum phase_values(const LayerPhase& phase, double one_minus_cosine, double one_plus_cosine);

// chi_0 .. chi_degree, in each channel.
std::vector<Spectrum> legendre_moments(const LayerPhase& phase, int degree);

// The layer with the coefficients that follow from its particles; any other as it is.
config::Layer with_coefficients(config::Layer layer);

// --- Checks --------------------------------------------------------------------------------------

// Whether particles are such that their scattering is known to be right, and layers of them such as
// bakers can take.

// E0144 of each kind of particles whose largest spheres are beyond kLargestSizeParameter, and of
// each layer whose extinction is beyond what coefficients may be.
[[nodiscard]] std::vector<config::Diagnostic> check_particles(const config::Parameters& parameters);

}  // namespace skybake
