// The sky by direct integration in double precision: what sky_view.h approximates.
//
//   single    integral of T sum over layers of sigma_s p(nu) T_sun dt
//   multiple  integral of T sigma_s Psi dt
//   ground    T (where the ray ends) times what the ground sends up
//
// T and T_sun are exact optical depths (optical_depth.h), Psi is the same closure that the table
// holds (Hillaire 2020), from its kernel on a fine grid made for this view
// (multiple_scattering_grid.h), the ground is that of sky_view.h: the difference of the two
// pictures is what tables, their interpolation and the marching cost, and not what the closure
// does.
//
// Rays are cut at the altitudes where a density changes its course, at their lowest point, at the
// planet's shadow and where the sun's own ray grazes one of those altitudes, then halved until no
// piece that light still reaches has an optical depth above 1; Gauss' rule with five nodes in each.
#pragma once

#include <vector>

#include "bakers/atmosphere/ray.h"
#include "bakers/core/image.h"
#include "bakers/preview/multiple_scattering_grid.h"
#include "bakers/preview/sky_medium.h"
#include "bakers/preview/sky_rays.h"

namespace skybake {

// In 1/sr, for a solar irradiance of 1.
struct SkyRadiance {
    Spectrum single{};
    Spectrum multiple{};
    Spectrum ground{};
    Spectrum total() const;
};

class SkyReference {
  public:
    // `medium` must outlive it. Of the view, altitude and sun.
    SkyReference(const SkyMedium& medium, const SkyView& view, int threads);

    // Within 2e-4 of single scattering by adaptive quadrature; the whole within about 1e-3, which
    // the grid of multiple scattering leaves.
    SkyRadiance radiance(const SkyDirection& direction) const;

    // Transmittance to the sun at a point where r mu_s = `s_km`; 0 in the planet's shadow.
    Spectrum sunlight(double altitude_km, double s_km) const;

  private:
    struct Ray;
    struct Piece;
    std::vector<double> cuts_km(const Ray& ray) const;
    Spectrum depth_km(const Ray& ray, double distance_km) const;
    void add_piece(const Ray& ray, const Piece& piece, int halvings, SkyRadiance& sum) const;
    Spectrum ground_radiance(double sun_s_km) const;

    const SkyMedium& medium_;
    Shell shell_;
    double altitude_km_;
    double r_km_;
    double sun_s_km_;
    double sun_cos_zenith_;
    std::vector<double> break_altitudes_km_;
    MultipleScatteringGrid multiple_scattering_;
};

// Pixels as of render_sky. The same bits for any number of threads.
Image2<float> render_sky_reference(const SkyMedium& medium, const SkyView& view, int threads);

}  // namespace skybake
