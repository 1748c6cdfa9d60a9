// Light scattered twice, from a sky of eight strips: the baseline after Ai et al. 2014 that the
// solution of all orders is compared with.
//
// At each point of the air the sky above its level is divided into eight strips, 45 degrees of
// azimuth each, from the horizon to the zenith; the sun stands between two of them. A strip has one
// radiance everywhere, that of light scattered once in the direction of its middle: halfway in
// azimuth, and 60 degrees from the zenith, which halves its solid angle. What comes from a strip is
// scattered by each layer's own phase function, integrated over the strip:
//
//   sum over layers of sigma_s sum over strips of L_strip integral of p over the strip.
//
// No light comes from below the level, nor any that was scattered more often. Strips right and left
// of the sun are alike, so that four radiances per altitude and sun are held, as a grid looked up
// linearly: the square root of the share of the altitude, and the sun's axis of twilight tables
// (multiple_scattering_mapping.h).
#pragma once

#include <array>
#include <vector>

#include "bakers/air/medium.h"
#include "bakers/field/image.h"
#include "bakers/light/higher_orders.h"
#include "bakers/math/bake_options.h"

namespace skybake {

class StripOrders : public HigherOrders {
  public:
    // After an interruption not to be used.
    StripOrders(const SkyMedium& medium, const BakeOptions& options);

    Spectrum scattered(const ScatteringPoint& point,
                       const std::vector<Spectrum>& scattering_per_km) const override;
    Spectrum sky_irradiance(double sun_cos_zenith) const override;

    // On each side of the sun, from it.
    static constexpr int kStrips = 4;

    // 1/sr for a solar irradiance of 1.
    std::array<Spectrum, kStrips> radiances(double altitude_km, double sun_cos_zenith) const;

  private:
    double thickness_km_;
    std::vector<LayerPhase> phases_;           // of each layer
    std::array<Image2<float>, kStrips> grid_;  // suns across, altitudes down
};

}  // namespace skybake
