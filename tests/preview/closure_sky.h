// The sky by direct integration (sky/sky_radiance.h) with the multiple scattering that Hillaire's
// table holds (Hillaire 2020), from its kernel on a fine grid made for this view
// (multiple_scattering_grid.h), and the ground of sky_view.h. A picture of sky_view.h from such
// tables differs from it by what tables, their interpolation and the marching cost, and not by what
// the closure costs: tests of the march hold it against this.
#pragma once

#include "bakers/field/image.h"
#include "bakers/light/higher_orders.h"
#include "bakers/light/sky_radiance.h"
#include "bakers/render/sky_rays.h"
#include "tests/preview/multiple_scattering_grid.h"

namespace skybake::test {

class ClosureSky {
  public:
    // `medium` must outlive it. The view's altitude and sun count alone.
    ClosureSky(const SkyMedium& medium, const SkyView& view, int threads);
    ClosureSky(const ClosureSky&) = delete;  // its parts refer to one another
    ClosureSky& operator=(const ClosureSky&) = delete;

    // Within about 1e-3, which the grid of multiple scattering leaves.
    SkyRadiance radiance(const SkyDirection& direction) const;

  private:
    double altitude_km_;
    SunZenith sun_;
    MultipleScatteringGrid multiple_scattering_;
    IsotropicOrders higher_orders_;
    SkyIntegrator integrator_;
};

// Pixels as of render_sky. The same bits for any number of threads.
Image2<float> render_closure_sky(const SkyMedium& medium, const SkyView& view, int threads);

}  // namespace skybake::test
