// This header makes spheres of OPAC's kinds of airborne particles, as
// [particles.NAME] has them.
#pragma once

#include <vector>

#include "config/optics/aerosol_components.h"
#include "config/sections/particles.h"

namespace skybake::config {

// Returns the spheres of a component, with its name. The relative humidity is
// in [0, 0.99].
Particles spheres_of(AerosolComponent component, double relative_humidity);

// Returns the kinds of spheres of a mixture with their numbers near the ground.
std::vector<SphereKind> kinds_of(AerosolMixture mixture, double relative_humidity);

}  // namespace skybake::config
