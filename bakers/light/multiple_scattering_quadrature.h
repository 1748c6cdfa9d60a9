// The directions and rays over which one row of the multiple-scattering table is integrated.
#pragma once

#include <vector>

#include "bakers/air/view_ray.h"

namespace skybake {

// The resolution of the integration. Levels are ordered by cost.
struct QuadratureLevel {
    int zenith_nodes = 0;          // Gauss-Legendre nodes above the horizon, and as many below
    double ray_tolerance = 0;      // see refine_view_ray
    double azimuth_tolerance = 0;  // error of the azimuths, as a share of the row's scattering
};

// Returns the levels that a bake may choose from.
const std::vector<QuadratureLevel>& quadrature_levels();

// Returns the number of sunlight lookups per texel at this level, for the cost model: a fixed
// figure for Earth's air.
double lookups_per_texel(const QuadratureLevel& level);

// A ray from the row's altitude, with its weight.
struct WeightedRay {
    double mu = 0;
    double weight = 0;  // share of the sphere of directions; they sum to 1
    std::vector<RayNode> nodes;
    std::vector<int> azimuths;  // per node: 1, 2, 4 or 8 azimuths of the sun
    bool hits_ground = false;
    double length_km = 0;          // to the ground or to the top
    int ground_azimuths = 1;       // azimuths where it meets the ground
    Spectrum end_transmittance{};  // of the whole ray
};

// The parts of the integral at one altitude that do not depend on the sun.
struct RowQuadrature {
    double altitude_km = 0;
    std::vector<WeightedRay> rays;
    Spectrum escape{};  // 1 - f: mean over directions of end transmittance and absorption
};

// Returns the altitudes at which rays are cut, for the rows of one table. Nodes at these altitudes
// share their sunlight.
std::vector<double> quadrature_altitudes_km(const Medium& medium);

RowQuadrature make_row_quadrature(const Medium& medium, const std::vector<double>& altitudes_km,
                                  double altitude_km, const QuadratureLevel& level);

}  // namespace skybake
