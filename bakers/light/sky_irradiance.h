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

#include <memory>
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

// The irradiance of surfaces at one altitude, in [0, thickness], under many suns. Directions that
// do not depend on the sun are traced once: those of light scattered before, and all under suns
// below the horizontal.
class SkyIrradiance {
  public:
    // `light` must outlive this object.
    SkyIrradiance(const SkyLight& light, double altitude_km);
    ~SkyIrradiance();
    SkyIrradiance(const SkyIrradiance&) = delete;
    SkyIrradiance& operator=(const SkyIrradiance&) = delete;

    // Returns the irradiance for a solar irradiance of 1, by light of light.orders() alone.
    // `sun_cos_zenith` is in [-1, 1].
    Spectrum under(double sun_cos_zenith, const IrradianceNodes& nodes);

  private:
    struct TracedZenith;
    using TracedZeniths = std::vector<TracedZenith>;

    TracedZeniths trace(double from, double to, int nodes, bool before) const;
    const TracedZeniths& kept(TracedZeniths& zeniths, int nodes, bool before) const;
    Spectrum single(const SunZenith& sun, int nodes);
    Spectrum multiple(const SunZenith& sun, const IrradianceNodes& nodes);

    const SkyLight& light_;
    double altitude_km_;
    SkyMedium once_;               // the medium without the peaks that no nodes would find
    std::vector<Spectrum> peaks_;  // of light scattered once alone: each layer's share of them
    SkyIntegrator once_integrator_;
    SkyIntegrator before_integrator_;
    std::unique_ptr<SkyIrradiance> apart_;  // of SkyLight::once, or null
    TracedZeniths dark_;                    // from the horizon up, of light scattered once
    TracedZeniths before_;                  // the same of light scattered before
};

// Returns the irradiance of one surface.
Spectrum sky_irradiance(const SkyLight& light, double altitude_km, double sun_cos_zenith,
                        const IrradianceNodes& nodes);

// Returns the irradiance of the same surface by sunlight that comes straight from the sun.
Spectrum sun_irradiance(const SkyLight& light, double altitude_km, double sun_cos_zenith);

}  // namespace skybake
