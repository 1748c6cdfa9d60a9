// Light that was solved for once in a run, for all assets that ask for it.
#pragma once

#include <memory>

#include "bakers/light/solver/solve_light.h"

namespace skybake {

// solve_light, or the last one's result where that was asked the same. After an interruption the
// light is not to be used, and is not remembered.
std::shared_ptr<const SolvedLight> remembered_light(const SkyMedium& medium,
                                                    const SolverSettings& settings, int threads,
                                                    Progress* progress);

}  // namespace skybake
