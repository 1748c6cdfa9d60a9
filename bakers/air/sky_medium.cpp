#include "bakers/air/sky_medium.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace skybake {

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
        sky_layer.scatters =
            std::any_of(layer.scattering.begin(), layer.scattering.end(),
                        [](const config::InverseLength& value) { return value.per_meter > 0; });
        medium.layers.push_back(std::move(sky_layer));
    }
    return medium;
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

}  // namespace skybake
