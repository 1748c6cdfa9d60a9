#include "bakers/plan/plan.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "bakers/assets/multiple_scattering/solved_scattering_table.h"
#include "bakers/math/facts.h"
#include "bakers/plan/bake_ways.h"
#include "bakers/plan/light_sheet.h"
#include "bakers/plan/light_truth.h"
#include "bakers/plan/light_ways.h"
#include "bakers/plan/sheet_pictures.h"
#include "config/assets/asset_kind.h"
#include "config/assets/multiple_scattering.h"

namespace skybake {
namespace {

constexpr int kLightViews = 192;
constexpr double kLightPaths = 3 << 19;

std::optional<Diagnostic> obstacle(const PlanSubject& subject, const Parameters& parameters) {
    if (!(parameters.atmosphere.top_radius.meters > 0)) {
        return diagnosis("E0105",
                         fmt::format("the recipe has no [atmosphere], so `plan` cannot draw {}",
                                     name_of(subject)));
    }
    if (parameters.wavelengths.size() <= kMaxChannels || holds_colors(parameters)) {
        return std::nullopt;
    }
    return diagnosis(
        "E0147",
        fmt::format("`plan` compares light of at most four wavelengths, or colours of any number; "
                    "the recipe has {}, and [color] has no space",
                    parameters.wavelengths.size()),
        "--set 'wavelengths=\"best 4\"' takes four");
}

// The scene has too few or too many suns for pictures and no other way is left, or `sky_by` allows no
// way.
Diagnostic no_ways(const PlanSubject& subject, const SceneRange& range) {
    const std::size_t suns = range.suns_deg.size();
    const bool has_suns = has_viewed_suns(range);
    const char* const label = has_suns ? "allow \"march\" or \"picture\" in `sky_by` of [scene]"
                              : subject.draws == config::Draws::surroundings
                                  ? "state the elevations of one to four `suns` in [scene]"
                                  : "state `suns` in [scene], or allow \"march\" in `sky_by`";
    return diagnosis(suns == 0 || has_suns ? "E0105" : "E0110",
                     fmt::format("no way to draw {} is left: pictures are compared for one to {} "
                                 "suns, and the scene has {}",
                                 name_of(subject), kMostViewedSuns, suns),
                     label);
}

// A recipe with all that the ways need.
struct PlannedScene {
    PlanSubject subject;
    Recipe recipe;
    SceneRange range;
    std::vector<LightWay> ways;
};

Outcome<PlannedScene> planned_scene(const PlanRequest& request, config::Draws light) {
    Outcome<Recipe> recipe = load_scene(request);
    if (!recipe.value) return {{}, std::move(recipe.diagnostics)};
    const Parameters& parameters = recipe.value->parameters;
    PlannedScene scene;
    scene.subject.draws = light;
    if (auto problem = obstacle(scene.subject, parameters)) return std::move(*problem);
    scene.range = range_of(*parameters.scene, shell_of(parameters.atmosphere));
    scene.ways = light_ways(light, parameters, scene.range);
    if (scene.ways.empty()) return no_ways(scene.subject, scene.range);
    std::erase_if(scene.ways, [&](const Way& way) { return request.leaves_out(way); });
    scene.recipe = std::move(*recipe.value);
    return {std::move(scene), {}};
}

// The weights of colours, if tables of light hold colours; any asset of light states them.
std::vector<glm::dvec3> weights_of(const Parameters& parameters,
                                   const std::vector<BakedAsset>& assets) {
    const auto stated = std::ranges::find_if(
        assets, [](const BakedAsset& asset) { return asset.baked.conventions.color.has_value(); });
    if (!holds_colors(parameters) || stated == assets.end()) return {};
    return weights_of(*stated->baked.conventions.color);
}

// Raise it whenever the same parameters give other figures and no baker's version tells so.
constexpr int kVersionOfLight = 5;

std::string text_of(const std::vector<LightView>& views) {
    std::string text;
    for (const auto& [sky, distance_km] : views) {
        text += fmt::format("{} {} {} {} {}\n", sky.altitude_km, sky.sun_elevation_deg,
                            sky.above_horizon_deg, sky.azimuth_deg, distance_km);
    }
    return text;
}

// Measures a way in the truth's views.
MeasuredWay measure_way(const LightOfWay& found, const SceneTruth& truth, const LightWay& way,
                        const std::vector<const BakedAsset*>& own) {
    MeasuredWay measured = costed(way, own);
    // A pixel looks up one of the pictures or, in each step of a march, every table and every moment.
    if (way.steps == 0) add_lookups(*own.front(), 1, measured.figures);
    for (const BakedAsset* asset : own) {
        const auto* scattering = asset->bake->find<config::MultipleScatteringBake>();
        add_lookups(*asset, way.steps * (scattering ? tables_of(*scattering) : 1),
                    measured.figures);
    }
    measured.error = truth.error(found.find(way, own));
    measured.figures.error = to_digits(measured.error.ninth_decile, 2);
    return measured;
}

// Measures the ways of a scene in views of it, and draws their sheet.
Outcome<MeasuredWays> measure(const PlanRequest& request, const PlannedScene& scene) {
    const WayAssets assets(scene.ways);
    const Outcome<Recipe> recipe = load_scene(request, assets.settings());
    if (!recipe.value) return {{}, recipe.diagnostics};
    const Parameters& parameters = recipe.value->parameters;
    const config::Draws light = scene.subject.draws;
    std::vector<LightView> views = scene_views(light, scene.range, shell_of(parameters.atmosphere),
                                               kLightViews, request.first_view());
    MeasuredWays plan;
    for (const LightWay& way : scene.ways) plan.ways.push_back({way, {}, {}});
    const double paths = request.paths > 0 ? request.paths : kLightPaths;
    const std::string key = figures_key(
        *recipe.value, config::reads_of_light(parameters, config::Roles::all()), assets, plan,
        fmt::format("{}, version {}, {} paths\n{}", word_of(scene.subject), kVersionOfLight, paths,
                    text_of(views)));
    if (find_figures(request.cache, key, plan)) return {std::move(plan), {}};
    const BakeOptions options{.threads = request.threads, .progress = request.progress};
    const Outcome<std::vector<BakedAsset>> baked = bake_ways(*recipe.value, assets, options);
    if (!baked.value) return {{}, baked.diagnostics};
    const std::vector<glm::dvec3> weights = weights_of(parameters, *baked.value);
    SceneTruth truth(light, parameters, std::move(views), weights, options);
    truth.trace(paths);
    const LightOfWay found(parameters, truth, request.threads);
    for (std::size_t i = 0; i < scene.ways.size(); ++i) {
        const LightWay& way = scene.ways[i];
        plan.ways[i] = measure_way(found, truth, way, assets.of(way, *baked.value));
    }
    if (request.judged != nullptr) return {std::move(plan), {}};
    std::vector<BakedWay<LightWay>> best;
    for (const std::size_t i : best_of_families(plan.ways)) {
        best.push_back({&scene.ways[i], assets.of(scene.ways[i], *baked.value)});
    }
    auto sheet = light_sheet(light, parameters, scene.range, best, weights, options);
    if (options.cancelled() || !sheet.value) return {{}, std::move(sheet.diagnostics)};
    plan.sheet = std::move(*sheet.value);
    std::vector<Diagnostic> problems = keep_figures(request.cache, key, plan);
    return {std::move(plan), std::move(problems)};
}

std::string suns_text(const SceneRange& range) {
    if (range.suns_deg.empty()) {
        return fmt::format("suns from {:.3g} to {:.3g} degrees", range.lowest_sun_deg,
                           range.highest_sun_deg);
    }
    return fmt::format("suns at {:.3g} degrees", fmt::join(range.suns_deg, ", "));
}

// The cameras and suns, and how far things are.
std::string scene_text(config::Draws light, const SceneRange& range) {
    std::string text = fmt::format("cameras from {:.3g} to {:.3g} km, {}", range.lowest_altitude_km,
                                   range.highest_altitude_km, suns_text(range));
    if (light == config::Draws::distance) {
        text += fmt::format(", things up to {:.3g} km away", range.view_distance_km);
    }
    return text;
}

ErrorWords words_of(config::Draws light, bool has_colors) {
    const bool is_sky = light == config::Draws::sky;
    ErrorWords words;
    words.compared = is_sky ? "sky error, ninth decile (%)" : "error, ninth decile (%)";
    words.claim = "at most {} % off in nine of ten views";
    words.column = "9 in 10 %";
    words.meaning = fmt::format(
        "of {} against paths of light{}, in the median, in nine of ten views, and the largest",
        has_colors                             ? "colours"
        : light == config::Draws::ground_light ? "irradiance"
                                               : "radiance",
        light == config::Draws::distance ? ", as shares of what is seen there without the thing"
                                         : "");
    words.remark =
        "# A bake's own error.sky is larger: it looks where skies are hardest, not evenly.\n";
    return words;
}

// Says what is left out, and why.
std::vector<std::string> notes_on(config::Draws light, const Parameters& parameters,
                                  const SceneRange& range) {
    std::vector<std::string> notes;
    const bool is_marched = light == config::Draws::sky || light == config::Draws::distance;
    if (is_marched && !has_viewed_suns(range)) {
        notes.push_back(fmt::format(
            "{} are left out: they are compared for one to {} suns (`suns` in [scene])",
            light == config::Draws::sky ? "sky views" : "volumes of air", kMostViewedSuns));
    }
    if (is_marched && parameters.wavelengths.size() > kMaxChannels) {
        notes.push_back(fmt::format("marches are left out: they would need all {} wavelengths",
                                    parameters.wavelengths.size()));
    }
    if (light == config::Draws::distance) {
        notes.emplace_back(
            "what the air leaves of a thing's own light is not compared: volumes hold it, and "
            "marches find it");
    }
    return notes;
}

}  // namespace

Outcome<Plan> plan_light(const PlanRequest& request, config::Draws light) {
    Outcome<PlannedScene> scene = planned_scene(request, light);
    if (!scene.value) return {{}, std::move(scene.diagnostics)};
    Outcome<MeasuredWays> measured = measure(request, *scene.value);
    if (!measured.value) return {{}, std::move(measured.diagnostics)};
    const Parameters& parameters = scene.value->recipe.parameters;
    Plan plan;
    plan.subject = scene.value->subject;
    plan.scene = scene_text(light, scene.value->range);
    plan.words = words_of(light, holds_colors(parameters));
    plan.reads = config::reads_of_light(parameters, config::Roles::all());
    plan.limits = limits_of(request, *parameters.scene, parameters.scene->max_sky_error);
    plan.ways = std::move(measured.value->ways);
    plan.sheet = std::move(measured.value->sheet);
    plan.notes = notes_on(light, parameters, scene.value->range);
    return chosen(std::move(plan), std::move(measured.diagnostics));
}

}  // namespace skybake
