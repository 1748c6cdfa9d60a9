// The irradiance of a level surface, facing up, by the sky: the integral of radiance times the
// cosine of the zenith angle over the upper hemisphere, without the sun's disc.
//
// Light scattered once varies fastest near the sun: zenith angles are split at the sun's, and both
// zenith angles and azimuths are spaced as squares of Gauss nodes away from it, or away from the
// horizon if the sun is below. Light scattered before is smooth and needs few nodes, concentrated
// at the horizon. Air that is thick up to great altitudes, like Mars's dust, needs three times as
// many nodes as the Earth's.
//
// Hard cases: a sun at the zenith (no panel above it) or at the horizon (no panel below it), and
// surfaces at the top (nothing above them).
#pragma once

#include <vector>

#include "bakers/light/sky_light.h"
#include "bakers/light/sky_radiance.h"

namespace skybake {

// The numbers of directions that are sampled.
struct IrradianceNodes {
    int single = 0;         // zenith angles on each side of the sun, and azimuths
    int zenith_angles = 6;  // of light scattered before
    int azimuths = 3;
};

// Returns the irradiance of surfaces at one altitude, in [0, thickness], for a solar irradiance of 1, by
// light of light.orders() alone: for each sun, given by the cosine of its zenith angle in [-1, 1].
// Directions that do not depend on the sun are traced once: those of light scattered before, and all
// under suns below the horizontal.
std::vector<Spectrum> sky_irradiances(const SkyLight& light, double altitude_km,
                                      const std::vector<double>& sun_cosines,
                                      const IrradianceNodes& nodes);

// Returns the irradiance of such a surface by sunlight that comes straight from the sun.
Spectrum sun_irradiance(const SkyLight& light, double altitude_km, double sun_cos_zenith);

}  // namespace skybake
