// Solves for all orders of scattering in a spherical atmosphere.
//
// The sum of all orders of scattering, x = b + K b + K^2 b ...
//
// It solves x = b + K x by the generalised minimal residual method (residual_search.h), whose
// directions are corrected by all orders on a coarse grid (coarse_orders.h). Earth's light takes
// three applications of K, and dense_earth's, with a zenith optical depth of 13, thirteen: order by
// order it would be a dozen and several hundred.
//
// The coarse grid's sum of a residual tells the truncation error. It is added at the end, so that
// the error that is left is smaller than what is said.
#pragma once

#include "bakers/air/medium.h"
#include "bakers/air/transmittance_field.h"
#include "bakers/light/solver/solved_light.h"
#include "bakers/math/bake_options.h"

namespace skybake {

// The resolution of the solution. With the defaults the mean radiance on Earth is within 0.06 %
// (median; at most 1.2 %) of a solution with several times as many of everything, and within 0.4 %
// on Mars (tests/benchmarks/README.md).
struct SolverSettings {
    int degree = 4;                // of the moments; at least 2
    int degree_of_all_orders = 8;  // at most, of light that is scattered more than three times
    int suns = 48;               // columns of the grid over the sun's zenith angle; a multiple of 8
    double level_scale = 1;      // factor on the number of altitudes
    int zenith_nodes = 8;        // directions above the horizon, and as many below it
    int first_zenith_nodes = 8;  // the same for light that is scattered once
    int first_azimuths = 0;      // of its directions, over half a turn; 0: as peaks need them
    double ray_tolerance = 2e-2;  // see refine_view_ray
    TransmittanceField::Size sunlight = {256, 128};
    double tolerance = 1e-3;  // for the truncation error, as a share of the light in the mean
    int most_applications = 200;
    int orders = 0;  // the last order that is summed; 0 for all orders
    bool operator==(const SolverSettings&) const = default;
};

// Returns settings that are finer in altitudes, directions and rays, as a reference to compare
// with. The resolution in the sun's angle matters least and is not changed.
SolverSettings finer(SolverSettings settings);

// The degree that skies have at least. More of it for light that is scattered often would cost more
// than the last order of refine_light.
inline constexpr int kLeastSkyDegree = 8;

// Returns the degree of moments that the sky of a medium needs: 8 for Earth's air, up to
// kLargestDegree for haze and fog (forward_peak.h).
int sky_degree(const SkyMedium& medium);

// Returns the light, for a solar irradiance of 1, that was scattered or reflected at least once, by
// every layer with its own phase function and by the ground. The bits are the same for any number
// of threads.
SolvedLight solve_light(const SkyMedium& medium, const SolverSettings& settings, int threads,
                        Progress* progress = nullptr);

}  // namespace skybake
