// The directions and rays over which one row of the multiple-scattering table is integrated.
#pragma once

#include <vector>

#include "bakers/air/view_ray.h"

namespace skybake {

// How finely to integrate. Levels are ordered by cost.
struct QuadratureLevel {
    int zenith_nodes = 0;          // Gauss-Legendre nodes above the horizon, and as many below
    double ray_tolerance = 0;      // see refine_view_ray
    double azimuth_tolerance = 0;  // error left by the azimuths, as a share of the row's scattering
};

// The levels a bake may choose from.
const std::vector<QuadratureLevel>& quadrature_levels();

// Sunlight lookups that a texel takes at this level, for the cost model: a fixed figure for Earth's
// air.
double lookups_per_texel(const QuadratureLevel& level);

// A direction from the row's altitude.
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

// All that the sun does not change for the points at one altitude.
struct RowQuadrature {
    double altitude_km = 0;
    std::vector<WeightedRay> rays;
    Spectrum escape{};  // 1 - f: mean over directions of end transmittance and absorption
};

// Altitudes that rays are cut at, for the rows of one table: nodes there share their sunlight.
std::vector<double> quadrature_altitudes_km(const Medium& medium);

RowQuadrature make_row_quadrature(const Medium& medium, const std::vector<double>& altitudes_km,
                                  double altitude_km, const QuadratureLevel& level);

}  // namespace skybake
