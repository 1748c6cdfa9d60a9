// Harmonics of functions over the upper hemisphere, by quadrature.
#pragma once

#include <vector>

#include "bakers/math/harmonics.h"
#include "bakers/math/vectors.h"

namespace skybake::cloud_light {

// Directions of the upper hemisphere with their solid angles: Gauss and Legendre's rule of the cosine
// of the zenith angle, and even steps of the azimuth.
struct SkyDirection {
    glm::dvec3 direction{};
    double solid_angle = 0;  // sr; their sum is 2 pi
};
std::vector<SkyDirection> sky_directions(int zenith, int around);

// The weight of a value at each direction in each coefficient.
using CoefficientWeights = std::vector<Harmonics>;

// Coefficients of the function that is 0 below the horizon: its integrals times each harmonic.
CoefficientWeights projection_weights(const std::vector<SkyDirection>& directions);

// Coefficients of the sum of harmonics, up to a degree, that is nearest to the values above the
// horizon by least squares over solid angle.
CoefficientWeights hemisphere_fit_weights(const std::vector<SkyDirection>& directions, int degree);

}  // namespace skybake::cloud_light
