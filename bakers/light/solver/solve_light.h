// All orders of scattering in a spherical atmosphere, solved.
#pragma once

#include <memory>
#include <vector>

#include "bakers/air/medium.h"
#include "bakers/air/transmittance_field.h"
#include "bakers/light/solver/solved_light.h"
#include "bakers/math/bake_options.h"

namespace skybake {

// How finely to solve. With the defaults the mean radiance is within 0.06 % (median; 1.2 % at
// most) of a solution with several times as many of everything on Earth, 0.4 % on Mars
// (tests/benchmarks/README.md).
struct SolverSettings {
    int degree = 4;          // of the moments, at least 2
    int suns = 48;           // columns of the grid over the sun's zenith angle, a multiple of 8
    double level_scale = 1;  // times this many altitudes
    int zenith_nodes = 8;    // of directions, above and below the horizon each
    double ray_tolerance = 2e-2;  // as of refine_view_ray
    TransmittanceField::Size sunlight = {512, 128};
    double tolerance = 1e-3;  // of what is left out, as a share of the light
    int plain_orders = 12;    // summed one by one before their sum is solved for
    int most_applications = 200;
    int orders = 0;  // of the light, summed up to that one and no further; 0: all
    bool operator==(const SolverSettings&) const = default;
};

// Finer in altitudes, directions and rays, to be measured against: the sun's angle matters least.
SolverSettings finer(SolverSettings settings);

// Light of solar irradiance 1 that was scattered or reflected at least once, by every layer with
// its own phase function and by the ground. The same bits for any number of threads.
SolvedLight solve_light(const SkyMedium& medium, const SolverSettings& settings, int threads,
                        Progress* progress = nullptr);

// Light that was solved for once in a run, for all assets that ask for it.

// solve_light, or the last one's result where that was asked the same. After an interruption the
// light is not to be used, and is not remembered.
std::shared_ptr<const SolvedLight> remembered_light(const SkyMedium& medium,
                                                    const SolverSettings& settings, int threads,
                                                    Progress* progress);

// The altitudes of a solution.

// Ascending, from the ground to the top, with every kink of the medium among them: closest where
// densities change and where the air is opaque, so that light is nearly linear between neighbours.
// `scale` multiplies their number.
std::vector<double> solution_levels_km(const Medium& medium, double scale);

}  // namespace skybake
