// The light that solve_light.h found, on its grid of altitudes and suns.
#pragma once

#include <vector>

#include "bakers/air/medium.h"
#include "bakers/light/solver/light_moments.h"
#include "bakers/light/solver/sun_axis.h"

namespace skybake {

// Where an altitude stands between levels.
struct LevelPlace {
    int level;        // the lower of two
    double fraction;  // of the way to the upper one
};

struct SolvedLight {
    int channels = 0;
    std::vector<double> altitudes_km;  // ascending, from the ground to the top
    SunAxis suns;
    // 1 for the stencils (by their first column) in which light falls too fast for cubics.
    std::vector<double> steep;
    LightField light;  // scattered or reflected once and more, for a solar irradiance of 1

    int applications = 0;  // of one more order
    double left_out = 0;   // bound of what further orders would add, as a share of the light

    int degree() const { return light.degree; }
    LevelPlace level_at(double altitude_km) const;
    // Weights of the columns around a sun.
    SunStencil stencil(double sun_cos_zenith) const;
    // Moments between the grid's points: values[lm].
    void moments_at(double altitude_km, double sun_cos_zenith, Spectrum* values) const;
    // L_00 / sqrt(4 pi): what Hillaire's texture stands for.
    Spectrum mean_radiance_at(double altitude_km, double sun_cos_zenith) const;
    // Irradiance of level ground by the sky, without the sun.
    Spectrum sky_irradiance_at(double sun_cos_zenith) const;
};

}  // namespace skybake
