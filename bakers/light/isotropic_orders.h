// Higher orders as runtimes with Hillaire's texture have them: the mean radiance Psi, scattered
// alike in all directions by every layer (Hillaire 2020, section 5.5).
//
// Psi at the ground is half sky (J_sky) and half ground (albedo (E_sun / pi + J_sky), the sky taken
// as equally bright all over), E_sun = mu_s T_sun; so J_sky = (2 Psi - albedo E_sun / pi) / (1 +
// albedo), and the sky's irradiance is pi J_sky.
#pragma once

#include <functional>

#include "bakers/light/higher_orders.h"

namespace skybake {

class IsotropicOrders : public HigherOrders {
  public:
    // Psi (1/sr) at an altitude for a cosine of the sun's zenith angle. `medium` must outlive it.
    using MeanRadiance = std::function<Spectrum(double altitude_km, double sun_cos_zenith)>;
    IsotropicOrders(const Medium& medium, MeanRadiance mean_radiance);

    Spectrum scattered(const ScatteringPoint& point,
                       const std::vector<Spectrum>& scattering_per_km) const override;
    Spectrum sky_irradiance(double sun_cos_zenith) const override;

  private:
    const Medium& medium_;
    MeanRadiance mean_radiance_;
};

}  // namespace skybake
