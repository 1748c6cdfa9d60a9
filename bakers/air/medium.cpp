#include "bakers/air/medium.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <utility>

#include "bakers/math/transcendental-inl.h"
#include "bakers/math/transcendental.h"
#include "config/sections/atmosphere.h"
#include "config/sections/layer.h"
#include "config/text/mapped.h"

namespace skybake {
namespace {

using config::Layer;
using config::Profile;

Spectrum per_km(const std::vector<config::InverseLength>& values) {
    Spectrum result{};
    for (std::size_t c = 0; c < values.size() && c < kMaxChannels; ++c) {
        result[c] = values[c].per_kilometer();
    }
    return result;
}

struct ProfilePoint {
    double altitude_km;
    double density;
};

// The profile as a polygon; two points at one altitude are a jump.
std::vector<ProfilePoint> profile_points(const Layer& layer) {
    switch (layer.profile) {
        case Profile::tent: {
            const double center = layer.center_altitude.kilometers();
            const double half_width = layer.half_width.kilometers();
            return {{center - half_width, 0}, {center, 1}, {center + half_width, 0}};
        }
        case Profile::slab:
            return {{layer.bottom_altitude.kilometers(), 1}, {layer.top_altitude.kilometers(), 1}};
        case Profile::tabulated: {
            return mapped<ProfilePoint>(layer.table, [&](const config::DensityPoint& point) {
                return ProfilePoint{point.altitude.kilometers(), point.density};
            });
        }
        case Profile::exponential:
        case Profile::standard:  // which recipes hold as a table
            break;
    }
    return {};
}

// The polygon's pieces, cut at the ground and at the top of the shell.
std::vector<LinearPiece> linear_pieces(const std::vector<ProfilePoint>& points,
                                       double thickness_km) {
    std::vector<LinearPiece> pieces;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const ProfilePoint low = points[i];
        const ProfilePoint high = points[i + 1];
        const double bottom = std::max(low.altitude_km, 0.0);
        const double top = std::min(high.altitude_km, thickness_km);
        if (!(bottom < top) || (low.density == 0 && high.density == 0)) continue;
        const double slope = (high.density - low.density) / (high.altitude_km - low.altitude_km);
        const LinearPiece whole{low.altitude_km, high.altitude_km, low.density, high.density,
                                slope};
        pieces.push_back({bottom, top, density_at(whole, bottom), density_at(whole, top), slope});
    }
    return pieces;
}

double density_at(const PiecewiseLayer& layer, double altitude_km) {
    const auto piece =
        std::ranges::lower_bound(layer.pieces, altitude_km, {}, &LinearPiece::top_km);
    const bool inside = piece != layer.pieces.end() && altitude_km >= piece->bottom_km;
    return inside ? density_at(*piece, altitude_km) : 0;
}

template <class Layer>
void add_layer(Coefficients& sum, double density, const Layer& layer) {
    sum.scattering_per_km += density * layer.scattering_per_km;
    sum.extinction_per_km += density * layer.extinction_per_km;
}

}  // namespace

Medium make_medium(const config::Atmosphere& atmosphere) {
    assert(atmosphere.ground_albedo.size() <= kMaxChannels);
    Medium medium;
    medium.channels = static_cast<int>(atmosphere.ground_albedo.size());
    medium.ground_radius_km = atmosphere.ground_radius.kilometers();
    // The difference in metres first: radii are large, the shell is thin.
    medium.thickness_km = (atmosphere.top_radius.meters - atmosphere.ground_radius.meters) / 1000;
    for (std::size_t c = 0; c < atmosphere.ground_albedo.size(); ++c) {
        medium.ground_albedo[c] = atmosphere.ground_albedo[c];
    }
    for (const Layer& given : atmosphere.layers) {
        const Layer layer = with_coefficients(given);
        const Spectrum extinction = per_km(layer.extinction);
        const bool opaque = largest(extinction) > 0;
        if (!layer.enabled || !opaque) continue;
        const Spectrum scattering = per_km(layer.scattering);
        if (layer.profile == Profile::exponential) {
            medium.exponential_layers.push_back(
                {layer.scale_height.kilometers(), scattering, extinction});
            continue;
        }
        auto pieces = linear_pieces(profile_points(layer), medium.thickness_km);
        if (!pieces.empty()) {
            medium.piecewise_layers.push_back({std::move(pieces), scattering, extinction});
        }
    }
    return medium;
}

std::vector<Coefficients> coefficients_at(const Medium& medium,
                                          const std::vector<double>& altitudes_km) {
    const std::size_t count = altitudes_km.size();
    std::vector<Coefficients> sums(count);
    std::vector<double> density(count);
    for (const ExponentialLayer& layer : medium.exponential_layers) {
        for (std::size_t i = 0; i < count; ++i) {
            density[i] = -altitudes_km[i] / layer.scale_height_km;
        }
        exponentials(density.data(), static_cast<int>(count));
        for (std::size_t i = 0; i < count; ++i) add_layer(sums[i], density[i], layer);
    }
    for (const PiecewiseLayer& layer : medium.piecewise_layers) {
        for (std::size_t i = 0; i < count; ++i) {
            add_layer(sums[i], density_at(layer, altitudes_km[i]), layer);
        }
    }
    return sums;
}

Coefficients coefficients_at(const Medium& medium, double altitude_km) {
    Coefficients sum;
    for (const ExponentialLayer& layer : medium.exponential_layers) {
        add_layer(sum, HWY_NAMESPACE::exponential(-altitude_km / layer.scale_height_km), layer);
    }
    for (const PiecewiseLayer& layer : medium.piecewise_layers) {
        add_layer(sum, density_at(layer, altitude_km), layer);
    }
    return sum;
}

Spectrum extinction_at(const Medium& medium, double altitude_km) {
    return coefficients_at(medium, altitude_km).extinction_per_km;
}

Spectrum scattering_at(const Medium& medium, double altitude_km) {
    return coefficients_at(medium, altitude_km).scattering_per_km;
}

std::vector<double> kink_altitudes_km(const Medium& medium) {
    std::vector<double> altitudes;
    for (const PiecewiseLayer& layer : medium.piecewise_layers) {
        for (const LinearPiece& piece : layer.pieces) {
            altitudes.push_back(piece.bottom_km);
            altitudes.push_back(piece.top_km);
        }
    }
    std::ranges::sort(altitudes);
    altitudes.erase(std::unique(altitudes.begin(), altitudes.end()), altitudes.end());
    return altitudes;
}

SkyMedium make_sky_medium(const config::Atmosphere& atmosphere) {
    SkyMedium medium;
    medium.air = make_medium(atmosphere);
    for (const config::Layer& given : atmosphere.layers) {
        const config::Layer layer = with_coefficients(given);
        config::Atmosphere single = atmosphere;
        single.layers = {layer};
        SkyLayer sky_layer;
        sky_layer.name = layer.name;
        sky_layer.alone = make_medium(single);
        if (sky_layer.alone.exponential_layers.empty() && sky_layer.alone.piecewise_layers.empty())
            continue;
        sky_layer.phase = layer_phase(layer);
        sky_layer.scatters = std::ranges::any_of(
            layer.scattering,
            [](const config::InverseLength& value) { return value.per_meter > 0; });
        medium.layers.push_back(std::move(sky_layer));
    }
    return medium;
}

Coefficients full_coefficients(const SkyLayer& layer) {
    const auto of = [](const auto& air) {
        return Coefficients{air.scattering_per_km, air.extinction_per_km};
    };
    const Medium& alone = layer.alone;
    return alone.exponential_layers.empty() ? of(alone.piecewise_layers.front())
                                            : of(alone.exponential_layers.front());
}

Spectrum first_phase_values(const SkyLayer& layer, double one_minus_cosine,
                            double one_plus_cosine) {
    if (layer.first_phase.functions.empty()) {
        return phase_values(layer.phase, one_minus_cosine, one_plus_cosine);
    }
    Spectrum values = phase_values(layer.first_phase, one_minus_cosine, one_plus_cosine);
    values *= layer.first_factor;
    return values;
}

std::vector<Spectrum> scattered_moments(const SkyLayer& layer, int degree) {
    std::vector<Spectrum> moments = legendre_moments(layer.phase, degree);
    for (Spectrum& moment : moments) {
        moment = (moment - layer.forward_share) / (1.0 - layer.forward_share);
    }
    return moments;
}

}  // namespace skybake
