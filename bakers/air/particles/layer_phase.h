// The phase functions of a layer of the atmosphere: closed forms are the same in all colour
// channels; those of spheres depend on each channel's wavelength.
#pragma once

#include <cstddef>
#include <vector>

#include "bakers/air/particles/phase_function.h"
#include "bakers/math/vectors.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/forward.h"

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

// Returns p in each channel for the cosine nu, given as 1 - nu and 1 + nu.
Spectrum phase_values(const LayerPhase& phase, double one_minus_cosine, double one_plus_cosine);

// Returns chi_0 to chi_degree of each channel.
std::vector<Spectrum> legendre_moments(const LayerPhase& phase, int degree);

// Returns the layer with the coefficients that follow from its particles; a layer of another kind
// is returned as it is.
config::Layer with_coefficients(config::Layer layer);

// --- Checks --------------------------------------------------------------------------------------

// Checks that the scattering of particles can be computed correctly, and that layers of them are
// within the limits of the bakers.

// Returns E0144 for each kind of particles whose largest spheres exceed kLargestSizeParameter, and
// for each layer whose extinction exceeds the limit of coefficients.
[[nodiscard]] std::vector<config::Diagnostic> check_particles(const config::Parameters& parameters);

}  // namespace skybake
