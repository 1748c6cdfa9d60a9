// How the value that a lookup of a cloud volume returns becomes density and extinction.
#pragma once

#include "config/sections/forward.h"

namespace skybake {

// How a lookup's value v becomes extinction. If the threshold is applied after filtering,
// extinction is extinction_per_m * v * smoothstep(threshold, threshold + edge_softness, v); else it
// is extinction_per_m * v. Particles scatter all of it.
struct CloudOptics {
    double extinction_per_m = 0;
    bool has_edge = false;
    double threshold = 0;
    double edge_softness = 0;
    config::CloudParticles particles{};
};

CloudOptics cloud_optics(const Cloud& cloud);

// Returns extinction / extinction_per_m for a value in double.
double density(const CloudOptics& optics, double value);

}  // namespace skybake
