// Whether particles are such that their scattering is known to be right, and layers of them such as
// bakers can take.
#pragma once

#include <vector>

#include "config/diagnostics/diagnostic.h"
#include "config/sections/parameters.h"

namespace skybake {

// E0144 of each kind of particles whose largest spheres are beyond kLargestSizeParameter, and of
// each layer whose extinction is beyond what coefficients may be.
[[nodiscard]] std::vector<config::Diagnostic> check_particles(const config::Parameters& parameters);

}  // namespace skybake
