// Higher orders as solved: moments of the light, scattered by each layer's own phase function.
#pragma once

#include <vector>

#include "bakers/air/sky_medium.h"
#include "bakers/light/higher_orders.h"
#include "bakers/light/solver/solved_light.h"

namespace skybake {

class SolvedOrders : public HigherOrders {
  public:
    // Uses moments up to `degree`, at most the solution's. Both must outlive it.
    SolvedOrders(const SkyMedium& medium, const SolvedLight& light, int degree);

    Spectrum scattered(const ScatteringPoint& point,
                       const std::vector<Spectrum>& scattering_per_km) const override;
    Spectrum sky_irradiance(double sun_cos_zenith) const override;

  private:
    const SolvedLight& light_;
    int degree_;
    std::vector<std::vector<Spectrum>> phase_moments_;  // of each layer
};

}  // namespace skybake
