// The texture of Hillaire's technique, fitted so that skies are right.
//
// Runtimes scatter the texture's Psi equally in all directions. With Psi = E0 / 4pi, the mean
// radiance, that is right on average over directions, but not for the views that a camera has. Here
// Psi is chosen so that the views of a scene are right in the sense of least squares: it is x >= 0
// times E0 / 4pi for each texel, and where views determine x poorly, x is drawn towards 1 and
// towards its neighbours. Texels that no view of the scene sees are E0 / 4pi.
//
// Errors are relative to the mean radiance of the sky around that camera under that sun, so that
// dusk counts as much as noon. The light of the ground itself is not fitted.
//
// On Earth with 64 x 32 texels and the twilight mapping the RMS error of skies that the fit has not
// seen falls from 4.5, 3.0, 2.3 to 3.1, 1.9, 1.6 % of the mean (R, G, B, sun at 89 degrees), and
// from 6.1, 4.0, 2.5 to 3.3, 2.5, 2.0 % at 94 degrees. The remaining error is the light around the
// sun that haze scatters forward, which no isotropic table holds: if haze had the phase function of
// air, the error would be less than a third in red. The light that the ground receives, which
// runtimes derive from Psi at the ground (higher_orders.h), is already too bright with E0 / 4pi and
// becomes brighter.
#pragma once

#include <array>
#include <optional>

#include "bakers/assets/multiple_scattering/fit_equations.h"
#include "bakers/field/image.h"
#include "bakers/field/table_model.h"
#include "bakers/light/multiple_scattering_mapping.h"

namespace skybake {

// How strongly x is restrained, in units of the errors of views that E0 / 4pi leaves under the
// median sun. The values were chosen by skies that the fit had not seen; factors of up to 10 change
// little.
struct FitSettings {
    FitDensity density;
    double ground_views = 0.1;  // weight of the air in front of the ground
    // The weights of the means of (x - 1)^2 and of the squared slopes of x, over the unit square of
    // altitude / thickness and the sun's place on the solution's axis (sun_axis.h).
    double towards_one = 0.05;
    double sun_smoothness = 5e-3;
    double altitude_smoothness = 5e-4;
    double tolerance = 1e-3;  // of positive_least_squares
};

// Returns Psi in 1/sr for a solar irradiance of 1, never negative. `light` should have degree 8.
// The bits are the same for any number of threads.
Image2<double> fit_mean_radiance(const SkyMedium& medium, const SolvedLight& light,
                                 const FitScene& scene, const FitAxes& axes,
                                 const FitSettings& settings, int threads);

// Returns the texels of the table with content = "fitted", fitted to the cameras and suns of the
// scene, or to FitScene's defaults without a scene.
Image2<double> fitted_texels(const SkyMedium& medium, const SolvedLight& light,
                             const std::optional<config::Scene>& scene, const SunColumns& columns,
                             std::array<int, 2> size, int threads);

// A table whose texels are given; between them it is defined by lookups. `texels` must outlive it.
TableModel fitted_model(const Image2<double>& texels);

}  // namespace skybake
