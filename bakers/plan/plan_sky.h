// Plans how a runtime draws the sky of a recipe: bakes the assets of all ways, and measures each way
// against one set of paths of light, in the views of the recipe's scene.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bakers/field/baked.h"
#include "bakers/math/bake_options.h"
#include "bakers/plan/choose_way.h"
#include "bakers/plan/scene_views.h"
#include "bakers/plan/sky_ways.h"
#include "bakers/report/variants.h"
#include "config/diagnostics/diagnostic.h"
#include "config/recipe/recipe.h"

namespace skybake {

// A way as it was measured.
struct MeasuredWay {
    SkyWay way;
    SkyError error;
    WayFigures figures;
    double bake_s = 0;  // wall time of its assets on all threads, light included that others share
    bool on_front = false;
};

struct SkyPlan {
    SceneRange range;
    std::string reference;  // the paths
    std::vector<MeasuredWay> ways;
    WayLimits limits;
    std::size_t chosen = 0;    // what keeps the limits, or the knee if there are none
    bool keeps_limits = true;  // false: no way does, and `chosen` has the least error
    bool has_colors = false;   // errors are those of colours
    std::size_t knee = 0;
    std::vector<std::string> notes;  // what was left out, and why
    std::string sheet;               // a PNG: the sky by paths, and by each family (sky_sheet.h)
};

struct PlanRequest {
    LoadRecipe load;
    std::filesystem::path cache;  // where measured figures are kept; empty: nowhere
    WayLimits limits;             // in place of those of the scene
    double paths = 3 << 19;       // of light, in all views together
    int threads = 0;
    Progress* progress = nullptr;
};

// Measures all ways and chooses one. Diagnostics are those of bake_asset; E0105 for a recipe without
// air; E0147 for one of more than four wavelengths; E0105 and E0110 if only sky views are allowed and
// there are no suns or too many; E0409 where paths find no light; E0408, beside the plan, if no way
// keeps the limits: `chosen` is then the way of least error; W0301 if the cache cannot be written.
// After an interruption there is neither a value nor a diagnostic.
config::Outcome<SkyPlan> plan_sky(const PlanRequest& request);

// Returns the ninth decile of a way's error in views that begin with number `first` of the scene,
// against paths of their own.
config::Outcome<SkyError> judge_way(const PlanRequest& request, const SkyWay& way,
                                    std::uint32_t first);

}  // namespace skybake
