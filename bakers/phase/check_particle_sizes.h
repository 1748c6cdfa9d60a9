// Whether spheres are of sizes whose series is known to be right.
#pragma once

#include <vector>

#include "config/diagnostic.h"
#include "config/parameters.h"

namespace skybake {

// E0144 of each kind of particles whose largest spheres are beyond kLargestSizeParameter.
std::vector<config::Diagnostic> check_particle_sizes(const config::Parameters& parameters);

}  // namespace skybake
