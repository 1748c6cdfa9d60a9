// The clear sky of a recipe above a cloud's layer, of which the asset's light is made.
//
// It is the sky that a camera at the layer's top would see, of all orders of scattering, without the
// sun's disc: its luminance by direction, divided by its mean over the upper hemisphere. The layer is
// flat and the horizon is not: what is seen below the horizontal is left out.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bakers/assets/cloud_light/cloud_layer.h"
#include "bakers/math/bake_options.h"
#include "bakers/math/intermediates.h"
#include "config/assets/cloud_light.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/cloud.h"
#include "config/sections/parameters.h"

namespace skybake::cloud_light {

// Returns the needs of an asset's sky: nothing, unless its contents are clear_sky_radiance.
std::vector<Need> sky_needs(const Parameters& parameters, const CloudLightBake& bake);

// Gives a cloud's layer the sky of the asset of that name, if its contents are clear_sky_radiance. Returns
// E0405 if the light of the sky could not be solved for, and E0189 if the sky is black. The layer
// has no sky after an interruption.
std::optional<Diagnostic> add_sky(const Parameters& parameters, const CloudLightBake& bake,
                                  const Cloud& cloud, const std::string& name,
                                  const BakeOptions& options, CloudLayer& layer);

}  // namespace skybake::cloud_light
