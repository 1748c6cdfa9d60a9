// The sky as a runtime finds it in a stored table of scattering.
#pragma once

#include <memory>
#include <vector>

#include "bakers/assets/description/probe_places.h"
#include "bakers/assets/sky/sky_samples.h"
#include "bakers/assets/sky/traced_light.h"
#include "config/assets/bruneton.h"

namespace skybake {

// Returns the radiance of the air at the samples, for a solar irradiance of 1. `packets` are the airs
// of the packets of wavelengths, and `places` those of the asset's probes.
LightAtPlaces sky_of_scattering(std::vector<std::shared_ptr<const TracedAir>> packets,
                                const config::BrunetonBake& asset, AssetPlaces places,
                                const std::vector<SkySample>& samples);

}  // namespace skybake
