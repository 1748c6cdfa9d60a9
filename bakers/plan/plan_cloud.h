// Plans how a runtime draws a cloud of a recipe in sunlight: bakes the assets of all ways, and measures
// each way against one set of paths of light, in the views of the recipe's scene.
#pragma once

#include <string>

#include "bakers/plan/plan.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// Measures all ways to draw the [clouds.NAME] and chooses one. The finest voxels are those of the first
// cloud_volume of the recipe that bakes it, or 256 along its longest edge. Diagnostics are those of
// bake_asset and of `chosen`; W0301 if the cache cannot be written. After an interruption there is
// neither a value nor a diagnostic.
Outcome<Plan> plan_cloud(const PlanRequest& request, const std::string& name);

}  // namespace skybake
