// The phase functions of a layer of the atmosphere: closed forms are the same in all colour
// channels; those of spheres depend on each channel's wavelength.
//
// The phase functions that an asset asks for, one per channel: the functions themselves and fine
// tables of them.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "bakers/air/particles/phase_function.h"
#include "bakers/math/facts.h"
#include "bakers/math/vectors.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/forward.h"

namespace skybake::config {
struct PhaseBake;
}  // namespace skybake::config

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
[[nodiscard]] std::vector<Diagnostic> check_particles(const Parameters& parameters);

struct PhaseSource {
    std::vector<PhaseFunction> functions;                       // one per wavelength
    std::vector<std::shared_ptr<const TabulatedPhase>> tables;  // to be inverted
    Facts facts;                                                // cross-sections, for particles
    std::string text;                                           // "particles fog", "layer mie"
    double error = 0;  // relative, of the functions themselves: error of the averages over sizes
};

// Returns the phase functions of particles, or of a layer of the atmosphere.
PhaseSource phase_source(const Parameters& parameters, const config::PhaseBake& bake, int threads);

}  // namespace skybake
