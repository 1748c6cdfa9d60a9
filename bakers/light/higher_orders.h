// Light that has been scattered or reflected before, as a sky integrator asks for it: the table of
// a runtime, or the solution that the table stands for.
#pragma once

#include <vector>

#include "bakers/air/medium.h"

namespace skybake {

// A point on a view ray, and the view as seen from there.
struct ScatteringPoint {
    double altitude_km = 0;
    double sun_cos_zenith = 0;
    double view_cos_zenith = 0;
    double azimuth_cosine =
        0;  // between view and sun; anything in [-1, 1] where either is vertical
};

class HigherOrders {
  public:
    virtual ~HigherOrders() = default;

    // Sum over layers of sigma_s integral of p L over directions, L the light that is no sunlight
    // straight from the sun: what a km of air sends towards the eye, in 1/sr/km for a solar
    // irradiance of 1. `scattering_per_km` has one entry per layer of the medium.
    virtual Spectrum scattered(const ScatteringPoint& point,
                               const std::vector<Spectrum>& scattering_per_km) const = 0;

    // Irradiance of level ground by the sky, without sunlight straight from the sun.
    virtual Spectrum sky_irradiance(double sun_cos_zenith) const = 0;
};

}  // namespace skybake
