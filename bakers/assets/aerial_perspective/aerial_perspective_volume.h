// The baker of `asset = "aerial_perspective"`.
#pragma once

#include <vector>

#include "bakers/assets/aerial_perspective/aerial_perspective_mapping.h"
#include "bakers/assets/sky/sky_lights.h"
#include "bakers/light/sky_light.h"
#include "bakers/math/bake_options.h"
#include "config/assets/aerial_perspective.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

struct Baked;

// Returns the light that the air adds to a picture and the transmittance by which it dims it, up to
// each of the distances, which ascend, along the ray at (u, v). The light is that scattered into
// the ray, in 1/sr for a solar irradiance of 1, without the ground's own. Beyond the point where
// the ray leaves the air nothing changes. Points below the ground are lifted to it
// (aerial_perspective_mapping.h).
std::vector<SkyRadiance> aerial_perspective(const SkyLight& light, const AerialCamera& camera,
                                            double u, double v,
                                            const std::vector<double>& distances_km);

// Bakes the froxels of one camera (aerial_perspective_mapping.h), which are held in memory.
// `volume` comes with name, parameters and details. Where the light becomes colours, each channel
// of a transmittance is the share of sunlight's that is left; deep red light has slightly negative
// green and blue ones.
Outcome<Baked> bake_aerial_perspective(const SkyLights& lights,
                                       const config::AerialPerspectiveBake& bake,
                                       const BakeOptions& options, Baked volume);

}  // namespace skybake
