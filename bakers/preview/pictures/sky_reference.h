// The solved sky as a picture, and what a picture from tables (sky_view.h) costs against it.
//
// The reference of every method is the same: all orders of scattering solved, each layer with its
// own phase function, sunlight and transmittance by exact optical depths, each ray by quadrature
// (sky/sky_light.h). It is what the asset `sky_view` bakes.
#pragma once

#include "bakers/field/certify.h"
#include "bakers/field/image.h"
#include "bakers/light/sky_light.h"
#include "bakers/render/sky_rays.h"
#include "bakers/render/sky_tables.h"

namespace skybake {

// Pixels as of render_sky, of the light's orders. The same bits for any number of threads.
Image2<float> render_sky_reference(const SkyLight& light, const SkyView& view, int threads);

// Segments per ray of a march that counts as exact: a march of half as many is within 0.02 % RMS.
inline constexpr int kExactSteps = 1280;

struct SkyCost {
    Image2<float> solved;      // the reference
    SkyDifference difference;  // of the picture from the tables in kSkySteps steps to the reference
    // Of the picture to one from the same tables in kExactSteps steps: the march's own part.
    ErrorFigures marching;
};

// `medium` and `tables` are of the light's atmosphere.
SkyCost sky_cost(const SkyMedium& medium, const SkyTables& tables, const SkyLight& light,
                 const SkyView& view, int threads);

}  // namespace skybake
