// The solution where phase functions have forward peaks that few moments cannot represent.
//
// Hazes and fogs scatter most light forward by a few degrees. Light that is scattered often is
// solved for in the medium of delta_scaled, in which scattering into the peaks counts as none. What
// that solution takes for sunlight but is light scattered forward is then moved to the light that
// was scattered. Last, two more orders of scattering in the true medium replace the moments by those
// of a higher degree:
//
//   x' = b + K x    x'' = b + K x'
//
// b is the light scattered once, by the true phase functions, to the higher degree; x has the
// moments of the first solution, and beyond its degree those of b; K scatters once more. Thus light
// scattered twice or three times is as exact as the higher degree, and an error of the first
// solution is scattered twice before it is seen.
//
// A series of moments that stops at a degree waves around a peak. By night, where the only light
// comes through thick air from a bright horizon, these waves may be larger than the light that is
// scattered to other directions, and sum to a mean below 0: to -1e-14 within a layer of an optical
// depth of 10, where moments to degree 16 in place of 8 find +1e-13. There the first solution, of a
// medium without peaks, stays.
#pragma once

#include "bakers/air/medium.h"
#include "bakers/light/solver/solve_light.h"
#include "bakers/light/solver/solved_light.h"
#include "bakers/math/bake_options.h"

namespace skybake {

// Adds the light that `light`, which was solved for in the medium `scaled`, takes for sunlight: the
// difference of the sun's transmittances of both media, from the sun's direction.
void add_forward_light(const SkyMedium& medium, const SkyMedium& scaled, SolvedLight& light);

// Replaces the light by x'', with moments to settings.degree.
// After an interruption the light must not be used.
void refine_light(const SkyMedium& medium, const SolverSettings& settings, int threads,
                  Progress* progress, SolvedLight& light);

}  // namespace skybake
