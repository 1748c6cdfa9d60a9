// All orders of scattering in a spherical atmosphere, solved.
#pragma once

#include "bakers/atmosphere/sky_medium.h"
#include "bakers/core/progress.h"
#include "bakers/scattering/solved_light.h"

namespace skybake {

// How finely to solve. The defaults are what bakers use (tests/benchmarks/README.md).
struct SolverSettings {
    int degree = 4;          // of the moments
    int suns = 96;           // columns of the grid, over the sun's zenith angle
    double level_scale = 1;  // times this many altitudes
    int zenith_nodes = 10;   // of directions, above and below the horizon each
    double ray_tolerance = 1e-2;
    double tolerance = 1e-4;  // of what further orders would add, as a share of the light
    int most_iterations = 200;
};

// Light of solar irradiance 1 that was scattered or reflected at least once, by every layer with
// its own phase function and by the ground. The same bits for any number of threads.
SolvedLight solve_light(const SkyMedium& medium, const SolverSettings& settings, int threads,
                        Progress* progress = nullptr);

}  // namespace skybake
