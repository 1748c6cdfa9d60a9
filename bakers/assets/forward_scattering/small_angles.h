// Sunlight that a cloud scatters on by small angles, of all orders of scattering.
//
// Textures of cloud_light hold harmonics up to a degree d of light that is scattered for the second
// time or more often. What they leave out is light of higher degrees, which goes on nearly
// straight. Light that is scattered by small angles only has passed about the sunlight's own path, and
// its moment of degree l has fallen by exp(-(1 - w chi_l) tau) at the optical depth tau (Goudsmit &
// Saunderson 1940; Wang & Guth 1951): chi_l are the moments of the phase function and w the albedo.
// In the scaled cloud of cloud_scattering.h, with f = w chi_(d+1) and s = 1 - f, the light that is sent
// on at the angle with the cosine nu, per extinction and for sunlight of 1, is F(nu, tau) with
//
//   4 pi F = sum_(l <= d) (2 l + 1) (w chi_l - f) exp(-s tau) P_l(nu)
//          + sum_(l > d) (2 l + 1) (w chi_l - f) exp(-(1 - w chi_l) tau) P_l(nu)
//
// The first sum is the light that the solver of cloud_light scatters for the first time. The second is
// the rest of the light that is scattered for the first time, and what the same light becomes as it is
// scattered again. Its terms tend to -f exp(-tau), which is light that was not scattered at all and is
// seen at nu = 1 only; other angles are evaluated with f exp(-tau) added to all terms, which adds
// nothing there. At tau = 0, F is w times the phase function p. The table holds
//
//   F / (w p exp(-s tau)),
//
// the factor by which light that is scattered once is multiplied, 1 at tau = 0.
#pragma once

#include <vector>

#include "bakers/air/particles/tabulated_phase.h"
#include "bakers/assets/cloud_light/cloud_scattering.h"

namespace skybake::forward_scattering {

class SmallAngles {
  public:
    // Takes the scattering of droplets and the solver's degree, >= 0.
    SmallAngles(cloud_light::CloudScattering scattering, int degree);

    // Writes the factors at some angles for one depth >= 0.
    void factors(double depth, const std::vector<ScatteringAngle>& angles, double* values) const;

    // Returns the same for one angle, by Clenshaw's recurrence from the highest degree down.
    double reference(double depth, const ScatteringAngle& angle) const;

    // s.
    double extinction_share() const { return 1 - peak_; }
    // w p, in 1/sr.
    double scattered_once(const ScatteringAngle& angle) const;
    // The number of degrees after which moments are below rounding.
    std::size_t terms() const { return moments_.size(); }

  private:
    // Returns 2 l + 1 times the terms of 4 pi F exp(s tau).
    std::vector<double> series(double depth) const;

    cloud_light::CloudScattering scattering_;
    int degree_;
    std::vector<double> moments_;  // w chi_l
    double peak_ = 0;              // f
};

}  // namespace skybake::forward_scattering
