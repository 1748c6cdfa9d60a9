// The sky and the ground around a camera, by longitude and latitude (asset = "environment").
#pragma once

#include "bakers/assets/sky_lights.h"
#include "bakers/field/baked.h"
#include "bakers/field/table_model.h"
#include "bakers/light/sky_light.h"
#include "bakers/light/sky_view_mapping.h"
#include "bakers/math/bake_options.h"
#include "config/assets/environment.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// Return the azimuth and the elevation of coordinates x and y in [0, 1], in degrees. The azimuth
// from the sun grows to the right, from -180 to 180; the elevation falls from the zenith, 90, to
// -90.
double environment_azimuth_deg(double x);
double environment_elevation_deg(double y);

// The table as a function: radiance (1/sr) towards the camera, computed as in sky_view_model. All
// arguments must outlive the model.
TableModel environment_model(const SkyLight& light, const SkyViewCamera& camera,
                             const SunZenith& sun);

// Bakes the sky from one altitude under one sun, without the sun's disc. `table` comes with name,
// parameters and channel names.
config::Outcome<Baked> bake_environment(const SkyLights& lights,
                                        const config::EnvironmentBake& bake,
                                        const BakeOptions& options, Baked table);

}  // namespace skybake
