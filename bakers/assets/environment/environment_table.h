// The sky, clouds and the ground around a camera (asset = "environment").
#pragma once

#include <span>
#include <vector>

#include "bakers/assets/environment/environment_mapping.h"
#include "bakers/assets/environment/environment_model.h"
#include "bakers/assets/sky/sky_lights.h"
#include "bakers/field/choose_probes.h"
#include "bakers/math/bake_options.h"
#include "config/assets/environment.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

struct Baked;

// Returns the place of coordinates x and y in [0, 1] of a part, as probes have it: the azimuth to the
// right of ahead and the elevation, in degrees. By longitude and latitude the azimuth grows from -180
// to 180, and the elevation falls from the zenith, 90, to -90.
Place environment_place(const EnvironmentLayout& layout, int part, double x, double y);

// Returns the factors of the channels that the asset holds: of one packet, or all; none if they are 1.
std::vector<double> solar_irradiance_of(const config::EnvironmentBake& bake);

// Bakes the sky from one altitude under one sun, without the sun's disc unless the bake asks for it.
// `table` comes with name, parameters and channel names. `media` are of the
// layers of clouds.
config::Outcome<Baked> bake_environment(const SkyLights& lights,
                                        const config::EnvironmentBake& bake,
                                        const BakeOptions& options, Baked table,
                                        std::span<const CloudMedium> media = {});

}  // namespace skybake
