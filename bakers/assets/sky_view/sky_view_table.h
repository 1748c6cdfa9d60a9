// The baker of `asset = "sky_view"`.
#pragma once

#include <vector>

#include "bakers/assets/sky/sky_lights.h"
#include "bakers/field/table_model.h"
#include "bakers/light/sky_light.h"
#include "bakers/light/sky_view_mapping.h"
#include "bakers/math/bake_options.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake::config {
struct SkyViewBake;
}  // namespace skybake::config

namespace skybake {

struct Baked;

// The table of one sun as a function: radiance (1/sr) at azimuth and angle of (x, y), computed by
// sky_row.h. The reference is SkyIntegrator, ray by ray. All arguments must outlive the model.
enum class SeenGround { lit, black };  // black: only its light at the end of rays is left out
TableModel sky_view_model(const SkyLight& light, const SkyViewCamera& camera, const SunZenith& sun,
                          SeenGround ground = SeenGround::lit);

// Writes the light that the asset shows of each of these, channel by channel.
void write_wanted(const SkyLight& light, SeenGround ground, std::vector<SkyRadiance> radiances,
                  double* values);

// Bakes the sky from one altitude under one sun or several (sky_view_mapping.h), without the sun's
// disc. `table` comes with name, parameters and channel names.
Outcome<Baked> bake_sky_view(const SkyLights& lights, const config::SkyViewBake& bake,
                             const BakeOptions& options, Baked table);

}  // namespace skybake
