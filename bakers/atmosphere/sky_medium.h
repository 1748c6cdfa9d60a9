// The air with its phase functions, layer by layer: what sky radiance needs and optical depths do
// not.
#pragma once

#include <vector>

#include "bakers/atmosphere/medium.h"
#include "bakers/phase/phase_function.h"

namespace skybake {

struct SkyLayer {
    Medium alone;  // the planet with this layer only
    PhaseFunction phase;
    bool scatters = false;
};

// Layers without extinction are left out.
struct SkyMedium {
    Medium air;  // all layers together
    std::vector<SkyLayer> layers;
};

SkyMedium make_sky_medium(const config::Atmosphere& atmosphere);

}  // namespace skybake
