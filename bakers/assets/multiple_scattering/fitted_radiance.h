// The texture of Hillaire's technique, made so that skies are right.
//
// Runtimes scatter the texture's Psi alike in all directions. With Psi = E0 / 4pi, the mean
// radiance, that is right on average over directions, not for the views that a camera has. Here Psi
// is what makes the views of a scene right, in the sense of least squares: texels x >= 0 times
// E0 / 4pi, drawn towards 1 and towards their neighbours where views say little. Texels that no
// view of the scene sees are E0 / 4pi.
//
// Errors count as shares of the mean radiance of the sky about that camera under that sun, so that
// dusk counts as much as noon. The light of the ground itself is not fitted.
//
// On Earth with 64 x 32 texels and the twilight mapping the RMS error of skies that the fit has not
// seen falls from 4.5, 3.0, 2.3 to 3.1, 1.9, 1.6 % of the mean (R, G, B, sun at 89 degrees), from
// 6.1, 4.0, 2.5 to 3.3, 2.5, 2.0 % at 94 degrees. What is left is the light about the sun that haze
// scatters forward, which no isotropic table has: were haze's phase that of air, it would be less
// than a third in red. What runtimes derive from Psi at the ground about the light that the ground
// receives (higher_orders.h), too bright with E0 / 4pi already, becomes brighter.
#pragma once

#include <array>
#include <optional>

#include "bakers/assets/multiple_scattering/fit_equations.h"
#include "bakers/field/image.h"
#include "bakers/field/table_model.h"
#include "bakers/light/multiple_scattering_mapping.h"

namespace skybake {

// How strongly x is held, the errors of views in units of those that E0 / 4pi leaves under the
// median sun. Chosen by skies that the fit had not seen; within a factor of 10 they change little.
struct FitSettings {
    FitDensity density;
    double ground_views = 0.1;  // how much the air before the ground counts
    // Over the unit square of altitude / thickness and the sun's place on the solution's axis
    // (sun_axis.h): times the mean of (x - 1)^2 and of the squared slopes of x.
    double towards_one = 0.05;
    double sun_smoothness = 5e-3;
    double altitude_smoothness = 5e-4;
    double tolerance = 1e-3;  // of positive_least_squares
};

// Psi in 1/sr for a solar irradiance of 1, never negative. `light` is best of degree 8. The same
// bits for any number of threads.
Image2<double> fit_mean_radiance(const SkyMedium& medium, const SolvedLight& light,
                                 const FitScene& scene, const FitAxes& axes,
                                 const FitSettings& settings, int threads);

// The table of content = "fitted" as bakers see it.

// Fitted to the cameras and suns of the scene; without one to FitScene's.
Image2<double> fitted_texels(const SkyMedium& medium, const SolvedLight& light,
                             const std::optional<config::Scene>& scene, const SunColumns& columns,
                             std::array<int, 2> size, int threads);

// A table whose texels are given: there is nothing between them but what lookups make of them.
// `texels` must outlive it.
TableModel fitted_model(const Image2<double>& texels);

}  // namespace skybake
