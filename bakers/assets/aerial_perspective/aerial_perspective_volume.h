// The baker of `asset = "aerial_perspective"`.
#pragma once

#include <string>
#include <vector>

#include "bakers/assets/aerial_perspective/aerial_perspective_mapping.h"
#include "bakers/field/baked.h"
#include "bakers/light/sky_light.h"
#include "bakers/math/bake_options.h"
#include "config/assets/aerial_perspective.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// What the air adds to a picture and takes from it: up to each of the distances, ascending, along
// the ray at (u, v). Light scattered into the ray (1/sr) for a solar irradiance of 1, without the
// ground's own. From where the ray leaves the air nothing changes; points below the ground are
// lifted to it (aerial_perspective_mapping.h).
std::vector<SkyRadiance> aerial_perspective(const SkyLight& light, const AerialCamera& camera,
                                            double u, double v,
                                            const std::vector<double>& distances_km);

// The froxels of one camera, aerial_perspective_mapping.h. Held in memory. `volume` brings name,
// parameters and details; `colour_names` are {"R", "G", "B"} or {"Y"}.
config::Outcome<Baked> bake_aerial_perspective(const SkyLight& light,
                                               const config::AerialPerspectiveBake& bake,
                                               const BakeOptions& options,
                                               const std::vector<std::string>& colour_names,
                                               Baked volume);

}  // namespace skybake
