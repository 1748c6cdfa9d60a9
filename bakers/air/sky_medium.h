// The air with its phase functions, layer by layer: what sky radiance needs and optical depths do
// not.
#pragma once

#include <string>
#include <vector>

#include "bakers/air/medium.h"
#include "bakers/air/particles/layer_phase.h"

namespace skybake {

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
