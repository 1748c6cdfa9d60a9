// The tables of two axes: transmittance to the top of the air, and irradiance of level surfaces by
// the sky.
#pragma once

#include "bakers/core/bake_options.h"
#include "bakers/core/volume.h"
#include "bakers/sky/sky_light.h"
#include "config/diagnostic.h"
#include "config/parameters.h"

namespace skybake {

// `volume` has its name, parameters, details and channels; takram's has an A of 1.
config::Outcome<BakedVolume> bake_bruneton_transmittance(const Medium& medium,
                                                         const config::BrunetonBake& bake,
                                                         const BakeOptions& options,
                                                         BakedVolume volume);

// By the orders of `light`, times the solar irradiance.
config::Outcome<BakedVolume> bake_bruneton_irradiance(const SkyLight& light,
                                                      const config::BrunetonBake& bake,
                                                      const BakeOptions& options,
                                                      BakedVolume volume);

}  // namespace skybake
