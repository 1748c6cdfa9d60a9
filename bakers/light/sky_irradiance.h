// The irradiance of a level surface, facing up, by the sky: the integral of radiance times the
// cosine of the zenith angle over the upper hemisphere, without the sun's disc.
//
// Light scattered once is sharpest at the sun: zenith angles are split at the sun's, and both they
// and azimuths go as squares of Gauss nodes away from it, or away from the horizon if the sun is
// below. Light scattered before is smooth and takes few of them, gathered at the horizon. Air
// that is thick as far up as Mars' dust takes three times as many as the Earth's.
//
// Hard cases: sun at the zenith (no panel above it), at the horizon (none below it), surfaces at
// the top (nothing above them).
#pragma once

#include "bakers/light/sky_light.h"

namespace skybake {

// How many directions are looked in.
struct IrradianceNodes {
    int single = 0;         // zenith angles on each side of the sun, and azimuths
    int zenith_angles = 6;  // of light scattered before
    int azimuths = 3;
};

// For a solar irradiance of 1, of light.orders() alone. `sun_cos_zenith` in [-1, 1], altitudes in
// [0, thickness].
Spectrum sky_irradiance(const SkyLight& light, double altitude_km, double sun_cos_zenith,
                        const IrradianceNodes& nodes);

// By sunlight that comes straight, at the same surface.
Spectrum sun_irradiance(const SkyLight& light, double altitude_km, double sun_cos_zenith);

}  // namespace skybake
