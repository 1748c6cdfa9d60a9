// The solved sky as a picture, and the error of a picture from tables (sky_view.h) compared with
// it.
//
// All methods have the same reference: all orders of scattering are solved, each layer has its own
// phase function, sunlight and transmittance come from exact optical depths, and each ray is
// integrated by quadrature (bakers/light/sky_light.h). The asset `sky_view` bakes the same sky.
#pragma once

#include "bakers/field/image.h"
#include "bakers/light/sky_light.h"
#include "bakers/render/sky_rays.h"
#include "bakers/render/sky_tables.h"

namespace skybake {

// Renders the solved sky with the orders of `light`. Pixels are as in render_sky. The bits are the
// same for any number of threads.
Image2<float> render_sky_reference(const SkyLight& light, const SkyView& view, int threads);

// The number of segments per ray of a march that counts as exact. A march with half as many differs
// by at most 0.02 % RMS.
inline constexpr int kExactSteps = 1280;

struct SkyCost {
    Image2<float> solved;      // the reference
    SkyDifference difference;  // of the tables' picture, in kSkySteps steps, from it
    // The error of the march alone: the difference of that picture from one with the same tables in
    // kExactSteps steps.
    ErrorFigures marching;
};

// Measures the error of the tables' picture. `medium` and `tables` must be of the atmosphere of
// `light`.
SkyCost sky_cost(const SkyMedium& medium, const SkyTables& tables, const SkyLight& light,
                 const SkyView& view, int threads);

}  // namespace skybake
