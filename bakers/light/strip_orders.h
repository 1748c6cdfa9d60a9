// Light scattered twice, from a sky of eight sectors: the baseline after Ai et al. 2014 with which
// the solution of all orders is compared.
//
// At each point of the air the sky above its level is divided into eight sky sectors ("strips" in
// recipes), 45 degrees of azimuth each, from the horizon to the zenith; the sun lies between two of
// them. A sector has one radiance everywhere, that of light scattered once in the direction of its
// middle: halfway in azimuth, and 60 degrees from the zenith, which halves its solid angle. The
// light from a sector is scattered by each layer's own phase function, integrated over the sector:
//
//   sum over layers of sigma_s sum over sectors of L_sector integral of p over the sector.
//
// No light comes from below the level, and none that was scattered more often. Sectors right and
// left of the sun are equal, so that four radiances per altitude and sun are stored, in a grid that
// is interpolated linearly. Its axes are the square root of altitude / thickness and the sun's axis
// of twilight tables (multiple_scattering_mapping.h).
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
    // After an interruption the object must not be used.
    StripOrders(const SkyMedium& medium, const BakeOptions& options);

    Spectrum scattered(const ScatteringPoint& point,
                       const std::vector<Spectrum>& scattering_per_km) const override;
    Spectrum sky_irradiance(double sun_cos_zenith) const override;

    // The number of sectors on each side of the sun, counted from the sun.
    static constexpr int kStrips = 4;

    // Returns the radiance of each sector in 1/sr for a solar irradiance of 1.
    std::array<Spectrum, kStrips> radiances(double altitude_km, double sun_cos_zenith) const;

  private:
    double thickness_km_;
    std::vector<LayerPhase> phases_;           // of each layer
    std::array<Image2<float>, kStrips> grid_;  // suns across, altitudes down
};

}  // namespace skybake
