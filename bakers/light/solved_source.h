// What the solved light sends along a view ray from one point of it, for any sun: solved_orders.h
// with all contracted that the sun does not change, for those who ask under many suns.
#pragma once

#include <vector>

#include "bakers/air/sky_medium.h"
#include "bakers/light/solver/solved_light.h"

namespace skybake {

class SolvedSource {
  public:
    // `scattering` has one entry per layer, `phase_moments` too: legendre_moments up to the light's
    // degree. The light must outlive it.
    SolvedSource(const SolvedLight& light, double altitude_km, double view_cos_zenith,
                 const std::vector<Spectrum>& scattering,
                 const std::vector<std::vector<Spectrum>>& phase_moments);

    // As SolvedOrders::scattered, to rounding.
    Spectrum scattered(double sun_cos_zenith, double azimuth_cosine) const;

  private:
    const SolvedLight& light_;
    std::vector<Spectrum> values_;  // [sun * (degree + 1) + m]
};

}  // namespace skybake
