// A plan: the measured ways to draw one thing, and the choice among them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bakers/math/bake_options.h"
#include "bakers/plan/bake_ways.h"
#include "bakers/plan/choose_way.h"
#include "bakers/report/measurement.h"
#include "config/diagnostics/diagnostic.h"
#include "config/recipe/recipe.h"

namespace skybake {

// How the error of a way is told. Limits and the choice are of `compared`.
struct ErrorWords {
    std::string compared;  // "sky error, ninth decile (%)"
    std::string claim;     // "at most {} % off in nine of ten views", with the figure in it
    std::string column;    // "9 in 10 %", of tables
    std::string meaning;   // of the errors, for the head of a table
    std::string remark;    // a comment of the written recipe; or empty
};

// A part of the light of a recipe's air, or a cloud.
struct PlanSubject {
    config::Draws draws = config::Draws::sky;
    std::string cloud;  // NAME of a [clouds.NAME]
    bool is_cloud() const { return draws == config::Draws::clouds; }
};

struct Plan {
    PlanSubject subject;
    std::string scene;      // "cameras from 0 to 3 km, suns from -6 to 90 degrees"
    std::string reference;  // the paths
    ErrorWords words;
    std::vector<config::Read> reads;  // what a recipe of the chosen way says besides its assets
    std::vector<MeasuredWay> ways;
    WayLimits limits;
    std::size_t chosen = 0;    // what keeps the limits, or the knee if there are none
    bool keeps_limits = true;  // false: no way does, and `chosen` has the least error
    std::size_t knee = 0;
    std::vector<std::string> notes;  // what was left out, and why
    std::string sheet;               // a PNG: pictures by paths, and by each family
};

struct PlanRequest {
    LoadRecipe load;
    std::filesystem::path cache;  // where measured figures are kept; empty: nowhere
    WayLimits limits;             // in place of those of the scene
    double paths = 0;             // of light, in all views together; 0: as many as the scene needs
    int threads = 0;
    Progress* progress = nullptr;
    // A way that was chosen: it alone is measured, in other views by other paths, without pictures.
    const Way* judged = nullptr;

    std::uint32_t first_view() const { return judged != nullptr ? 4096 : 1; }
    bool leaves_out(const Way& way) const;
};

// Reads the recipe with its [scene], or one that says nothing, and further settings.
Outcome<Recipe> load_scene(const PlanRequest& request,
                           const std::vector<std::string>& settings = {});

// Returns "the sky", or "the cloud `cumulus`".
std::string name_of(const PlanSubject& subject);

// Returns "sky", or "clouds.cumulus".
std::string word_of(const PlanSubject& subject);

// Returns what the recipe has and its scene draws.
std::vector<PlanSubject> subjects_of(const Parameters& parameters);

// Returns limits of the request, or else those of the scene, with this bound on the error.
WayLimits limits_of(const PlanRequest& request, const config::Scene& scene,
                    const std::optional<double>& max_error);

// Returns E0409, since no light reaches the subject.
Outcome<Plan> without_light(const PlanSubject& subject);

// Returns the numbers of ways, the least compared error first.
std::vector<std::size_t> by_error(const std::vector<MeasuredWay>& ways);

// Finds the front of a measured plan, its knee and the way to take. Adds E0408, beside the plan, if no way
// keeps the limits: `chosen` is then the way of least error. Returns E0409 alone where paths find no
// light to compare with.
Outcome<Plan> chosen(Plan plan, std::vector<Diagnostic> diagnostics);

// Measures all ways to draw a part of the light of a recipe's air, the sky, the air before things, the
// light on the ground or the surroundings, and chooses one: bakes the assets of all ways, and measures
// each against one set of paths of light, in the views of the recipe's scene. Diagnostics are those of
// bake_asset; E0105 for a recipe without air; E0147 for one of more than four wavelengths that are no
// colours; E0105 and E0110 if only pictures are left and there are no suns or too many; those of
// `chosen`; W0301 if the cache cannot be written. After an interruption there is neither a value nor a
// diagnostic.
Outcome<Plan> plan_light(const PlanRequest& request, config::Draws light);

// Does the same for the [clouds.NAME] in sunlight. The finest voxels are those of the first
// cloud_volume of the recipe that bakes it, or 256 along its longest edge.
Outcome<Plan> plan_cloud(const PlanRequest& request, const std::string& name);

}  // namespace skybake
