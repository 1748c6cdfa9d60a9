// The radiance of the sky along one ray by direct integration, in double precision.
//
//   single    integral of T sum over layers of sigma_s p(nu) T_sun dt
//   multiple  integral of T (what HigherOrders scatters) dt
//   ground    T (where the ray ends) albedo / pi (mu_s T_sun + sky irradiance)
//
// T and T_sun are exact optical depths (optical_depth.h).
//
// Rays are cut at the altitudes where a density changes its course, at their lowest point, at the
// planet's shadow and where the sun's own ray grazes one of those altitudes, then halved until no
// piece that light still reaches has an optical depth above 1; Gauss' rule with five nodes in each.
//
// Hard cases: the sun on the horizon and below (rays that graze the shadow), at the zenith, as the
// direction itself; the camera on the ground (rays below the horizontal have length 0), at the top
// and in space (rays that miss the air are black); a horizon 40 degrees down; 50 times the air; no
// air at all.
#pragma once

#include <vector>

#include "bakers/atmosphere/ray.h"
#include "bakers/atmosphere/sky_medium.h"
#include "bakers/sky/higher_orders.h"
#include "bakers/sky/sky_direction.h"

namespace skybake {

// In 1/sr, for a solar irradiance of 1.
struct SkyRadiance {
    Spectrum single{};
    Spectrum multiple{};
    Spectrum ground{};
    Spectrum transmittance{};  // along the whole ray
    Spectrum total() const;    // of the light
};

class SkyIntegrator {
  public:
    // Both must outlive it. Without higher orders only single scattering and ground in sunlight.
    SkyIntegrator(const SkyMedium& medium, const HigherOrders* higher_orders);

    // From an altitude in [0, thickness]. Single scattering within 2e-4 of adaptive quadrature.
    SkyRadiance radiance(double altitude_km, const SunZenith& sun,
                         const SkyDirection& direction) const;

    // Transmittance to the sun at a point where r mu_s = `s_km`; 0 in the planet's shadow.
    Spectrum sunlight(double altitude_km, double s_km) const;

  private:
    struct Ray;
    struct Piece;
    std::vector<double> cuts_km(const Ray& ray) const;
    Spectrum depth_km(const Ray& ray, double distance_km) const;
    ScatteringPoint scattering_point(const Ray& ray, double altitude_km, double sun_s_km,
                                     double distance_km) const;
    void add_piece(const Ray& ray, const Piece& piece, int halvings, SkyRadiance& sum) const;
    Spectrum ground_radiance(double sun_s_km) const;

    const SkyMedium& medium_;
    const HigherOrders* higher_orders_;
    Shell shell_;
    std::vector<double> break_altitudes_km_;
};

}  // namespace skybake
