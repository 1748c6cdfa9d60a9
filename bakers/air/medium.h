// The air of a planet in the form that the kernels need: lengths in km, coefficients per km, and
// layers sorted into the two forms that have integrals of their own; with and without phase
// functions.
#pragma once

#include <string>
#include <vector>

#include "bakers/air/particles/layer_phase.h"
#include "config/sections/forward.h"

namespace skybake {

// The density is exp(-h / scale_height) at altitude h.
struct ExponentialLayer {
    double scale_height_km = 0;
    Spectrum scattering_per_km{};
    Spectrum extinction_per_km{};
    bool operator==(const ExponentialLayer&) const = default;
};

// A density that is linear between two altitudes.
struct LinearPiece {
    double bottom_km = 0;
    double top_km = 0;
    double density_at_bottom = 0;
    double density_at_top = 0;
    double density_per_km = 0;  // slope
    bool operator==(const LinearPiece&) const = default;
};

// Returns the density at an altitude within the piece. It is measured from the end where the
// density is smaller, so that it is a sum of terms that are not negative.
inline double density_at(const LinearPiece& piece, double altitude_km) {
    if (piece.density_per_km < 0) {
        return piece.density_at_top - piece.density_per_km * (piece.top_km - altitude_km);
    }
    return piece.density_at_bottom + piece.density_per_km * (altitude_km - piece.bottom_km);
}

// A density given piece by piece, and zero elsewhere: slabs, tents and tables.
struct PiecewiseLayer {
    std::vector<LinearPiece> pieces;  // ascending, within the shell
    Spectrum scattering_per_km{};
    Spectrum extinction_per_km{};
    bool operator==(const PiecewiseLayer&) const = default;
};

// Layers without extinction have no effect, so they are left out and cost nothing.
struct Medium {
    int channels = 0;
    double ground_radius_km = 0;
    double thickness_km = 0;  // top radius - ground radius
    Spectrum ground_albedo{};
    std::vector<ExponentialLayer> exponential_layers;
    std::vector<PiecewiseLayer> piecewise_layers;

    double top_radius_km() const { return ground_radius_km + thickness_km; }
    bool operator==(const Medium&) const = default;
};

// Makes the medium and computes the coefficients of layers of particles.
Medium make_medium(const config::Atmosphere& atmosphere);

struct Coefficients {
    Spectrum scattering_per_km{};
    Spectrum extinction_per_km{};
};

// Return the coefficients at altitudes in [0, thickness], many altitudes at once or one.
std::vector<Coefficients> coefficients_at(const Medium& medium,
                                          const std::vector<double>& altitudes_km);
Coefficients coefficients_at(const Medium& medium, double altitude_km);
Spectrum extinction_at(const Medium& medium, double altitude_km);
Spectrum scattering_at(const Medium& medium, double altitude_km);

// Returns the altitudes inside the shell where the density or its slope jumps, ascending, without
// duplicates.
std::vector<double> kink_altitudes_km(const Medium& medium);

// --- Layers with their phase functions -----------------------------------------------------------

// One layer with its phase function. Sky radiance needs phase functions; optical depths do not.
struct SkyLayer {
    std::string name;
    Medium alone;  // the planet with this layer only
    LayerPhase phase;
    bool scatters = false;
    // The phase function for light that is scattered for the first time, where it differs from
    // `phase`. It is multiplied by first_factor (forward_peak.h).
    LayerPhase first_phase;
    Spectrum first_factor = Spectrum(1.0);
    // The share of `phase` that counts as not scattered (delta-M, forward_peak.h): the light that
    // is scattered again has the moments of scattered_moments.
    Spectrum forward_share{};
    bool operator==(const SkyLayer&) const = default;
};

// Returns the layer's coefficients where its density is 1.
Coefficients full_coefficients(const SkyLayer& layer);

// Returns the phase function's values for light that is scattered for the first time, per channel,
// in 1/sr.
Spectrum first_phase_values(const SkyLayer& layer, double one_minus_cosine, double one_plus_cosine);

// Returns the moments chi_0 to chi_degree with which a layer scatters light again: (chi_l - f) /
// (1 - f), where f is its forward_share.
std::vector<Spectrum> scattered_moments(const SkyLayer& layer, int degree);

// The air with its layers. Layers without extinction are left out.
struct SkyMedium {
    Medium air;  // all layers together
    std::vector<SkyLayer> layers;
    bool operator==(const SkyMedium&) const = default;
};

SkyMedium make_sky_medium(const config::Atmosphere& atmosphere);

}  // namespace skybake
