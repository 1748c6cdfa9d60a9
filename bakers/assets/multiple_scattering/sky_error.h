// Measures the quality of a table of multiple scattering by comparing the sky made with it with a
// better sky.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bakers/field/baked.h"
#include "bakers/light/sky_radiance.h"
#include "config/sections/scene.h"

namespace skybake {

struct SkySample {
    double altitude_km = 0;
    SunZenith sun;
    SkyDirection direction;
};

// Returns samples for a camera near the ground: suns from the zenith to 6 degrees below the
// horizon, and views from 15 degrees off the zenith to half a degree above the horizontal, at
// several azimuths. For a scene, camera and suns are within its ranges.
std::vector<SkySample> sky_samples(const Shell& shell, const std::optional<config::Scene>& scene);

// Returns the light that reaches the camera through the air: single and multiple scattering,
// without the ground.
std::vector<Spectrum> sky_values(const SkyMedium& medium, const HigherOrders& higher_orders,
                                 const std::vector<SkySample>& samples, int threads);

// Returns the error |value / reference - 1| over all samples and channels, except those without
// light.
SkyError sky_error(int channels, const std::vector<Spectrum>& values,
                   const std::vector<Spectrum>& references);

}  // namespace skybake
