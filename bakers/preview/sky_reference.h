// The sky by direct integration (sky/sky_radiance.h): what sky_view.h approximates. Multiple
// scattering is the same closure that the table holds (Hillaire 2020), from its kernel on a fine
// grid made for this view (multiple_scattering_grid.h), the ground is that of sky_view.h: the
// difference of the two pictures is what tables, their interpolation and the marching cost, and not
// what the closure does.
#pragma once

#include "bakers/core/image.h"
#include "bakers/preview/multiple_scattering_grid.h"
#include "bakers/preview/sky_rays.h"
#include "bakers/sky/isotropic_orders.h"
#include "bakers/sky/sky_radiance.h"

namespace skybake {

class SkyReference {
  public:
    // `medium` must outlive it. Of the view, altitude and sun.
    SkyReference(const SkyMedium& medium, const SkyView& view, int threads);
    SkyReference(const SkyReference&) = delete;  // its parts refer to one another
    SkyReference& operator=(const SkyReference&) = delete;

    // Within about 1e-3, which the grid of multiple scattering leaves.
    SkyRadiance radiance(const SkyDirection& direction) const;

    // Transmittance to the sun at a point where r mu_s = `s_km`; 0 in the planet's shadow.
    Spectrum sunlight(double altitude_km, double s_km) const;

  private:
    double altitude_km_;
    SunZenith sun_;
    MultipleScatteringGrid multiple_scattering_;
    IsotropicOrders higher_orders_;
    SkyIntegrator integrator_;
};

// Pixels as of render_sky. The same bits for any number of threads.
Image2<float> render_sky_reference(const SkyMedium& medium, const SkyView& view, int threads);

}  // namespace skybake
