// The light that solve_light.h found, on its grid of altitudes and suns.
#pragma once

#include <vector>

#include "bakers/atmosphere/medium.h"
#include "bakers/scattering/sun_axis.h"

namespace skybake {

struct SolvedLight {
    int degree = 0;
    int channels = 0;
    std::vector<double> altitudes_km;  // ascending, from the ground to the top
    SunAxis suns;
    // Light scattered or reflected once and more, 1/sr times sr^(1/2) (light_moments.h):
    // moments[((level * suns.count + sun) * moment_count(degree) + lm) * channels + channel].
    std::vector<double> moments;
    // Irradiance of the ground by the sky, without the sun: sky_irradiance[sun * channels + c].
    std::vector<double> sky_irradiance;

    int iterations = 0;
    double left_out = 0;  // bound of what further orders would add, as a share of the light

    // Between the grid's points, by cubics: values[lm * channels + channel].
    void moments_at(double altitude_km, double sun_cos_zenith, double* values) const;
    Spectrum sky_irradiance_at(double sun_cos_zenith) const;
    // L_00 / sqrt(4 pi): what Hillaire's texture stands for.
    Spectrum mean_radiance_at(double altitude_km, double sun_cos_zenith) const;
};

}  // namespace skybake
