// Plans how a runtime draws the sky of a recipe: bakes the assets of all ways, and measures each way
// against one set of paths of light, in the views of the recipe's scene.
#pragma once

#include <cstdint>

#include "bakers/plan/plan.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// Measures all ways and chooses one. Diagnostics are those of bake_asset; E0105 for a recipe without
// air; E0147 for one of more than four wavelengths; E0105 and E0110 if only sky views are allowed and
// there are no suns or too many; those of `chosen`; W0301 if the cache cannot be written. After an
// interruption there is neither a value nor a diagnostic.
Outcome<Plan> plan_sky(const PlanRequest& request);

// Returns a way's error in views that begin with number `first` of the scene, against paths of their own.
Outcome<SkyError> judge_sky(const PlanRequest& request, const Way& way, std::uint32_t first);

}  // namespace skybake
