// Plans how a runtime draws a part of the light of a recipe's air: the sky, the air before things, the
// light on the ground or the surroundings. It bakes the assets of all ways, and measures each way against
// one set of paths of light, in the views of the recipe's scene.
#pragma once

#include "bakers/plan/plan.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// Measures all ways and chooses one. Diagnostics are those of bake_asset; E0105 for a recipe without
// air; E0147 for one of more than four wavelengths that are no colours; E0105 and E0110 if only pictures
// are left and there are no suns or too many; those of `chosen`; W0301 if the cache cannot be written.
// After an interruption there is neither a value nor a diagnostic.
Outcome<Plan> plan_light(const PlanRequest& request, config::Draws light);

}  // namespace skybake
