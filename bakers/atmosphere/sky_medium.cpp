#include "bakers/atmosphere/sky_medium.h"

#include <algorithm>
#include <utility>

namespace skybake {

SkyMedium make_sky_medium(const config::Atmosphere& atmosphere) {
    SkyMedium medium;
    medium.air = make_medium(atmosphere);
    for (const config::Layer& layer : atmosphere.layers) {
        config::Atmosphere single = atmosphere;
        single.layers = {layer};
        SkyLayer sky_layer;
        sky_layer.alone = make_medium(single);
        if (sky_layer.alone.exponential_layers.empty() && sky_layer.alone.piecewise_layers.empty())
            continue;
        sky_layer.phase = make_phase_function(layer.phase, layer.g);
        sky_layer.scatters =
            std::any_of(layer.scattering.begin(), layer.scattering.end(),
                        [](const config::InverseLength& value) { return value.per_meter > 0; });
        medium.layers.push_back(std::move(sky_layer));
    }
    return medium;
}

}  // namespace skybake
