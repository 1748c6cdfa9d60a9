// The air of a planet as the kernels want it: lengths in km, coefficients per km, layers sorted
// into the two forms that have their own integrals.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "bakers/air/particles/layer_phase.h"
#include "config/sections/atmosphere.h"

namespace skybake {

// Density exp(-h / scale_height), h the altitude.
struct ExponentialLayer {
    double scale_height_km = 0;
    Spectrum scattering_per_km{};
    Spectrum extinction_per_km{};
    bool operator==(const ExponentialLayer&) const = default;
};

// Density that is linear between two altitudes.
struct LinearPiece {
    double bottom_km = 0;
    double top_km = 0;
    double density_at_bottom = 0;
    double density_at_top = 0;
    double density_per_km = 0;  // slope
    bool operator==(const LinearPiece&) const = default;
};

// The density at an altitude within the piece, measured from the end where it is smaller: a sum of
// terms that are not negative.
inline double density_at(const LinearPiece& piece, double altitude_km) {
    if (piece.density_per_km < 0) {
        return piece.density_at_top - piece.density_per_km * (piece.top_km - altitude_km);
    }
    return piece.density_at_bottom + piece.density_per_km * (altitude_km - piece.bottom_km);
}

// Density given piece by piece, zero elsewhere: slabs, tents, tables.
struct PiecewiseLayer {
    std::vector<LinearPiece> pieces;  // ascending, within the shell
    Spectrum scattering_per_km{};
    Spectrum extinction_per_km{};
    bool operator==(const PiecewiseLayer&) const = default;
};

// Layers without extinction have no effect and are left out, so they cost nothing.
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

// Coefficients of layers of particles are found on the way.
Medium make_medium(const config::Atmosphere& atmosphere);

struct Coefficients {
    Spectrum scattering_per_km{};
    Spectrum extinction_per_km{};
};

// At altitudes in [0, thickness], many at once.
std::vector<Coefficients> coefficients_at(const Medium& medium,
                                          const std::vector<double>& altitudes_km);
Coefficients coefficients_at(const Medium& medium, double altitude_km);
Spectrum extinction_at(const Medium& medium, double altitude_km);
Spectrum scattering_at(const Medium& medium, double altitude_km);

// Altitudes inside the shell where the density or its slope jumps, ascending, without duplicates.
std::vector<double> kink_altitudes_km(const Medium& medium);

// --- Layers with their phase functions -----------------------------------------------------------

// The air with its phase functions, layer by layer: what sky radiance needs and optical depths do
// not.

struct SkyLayer {
    std::string name;
    Medium alone;  // the planet with this layer only
    LayerPhase phase;
    bool scatters = false;
    // Of light scattered for the first time, where that is another one than `phase`: times
    // first_factor (forward_peak.h).
    LayerPhase first_phase;
    Spectrum first_factor = Spectrum(1.0);
    bool operator==(const SkyLayer&) const = default;
};

// How the layer scatters light for the first time, per channel.
Spectrum first_phase_values(const SkyLayer& layer, double one_minus_cosine, double one_plus_cosine);

// Layers without extinction are left out.
struct SkyMedium {
    Medium air;  // all layers together
    std::vector<SkyLayer> layers;
    bool operator==(const SkyMedium&) const = default;
};

SkyMedium make_sky_medium(const config::Atmosphere& atmosphere);

}  // namespace skybake
