#include "bakers/plan/plan_sky.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "bakers/assets/registry/registry.h"
#include "bakers/io/files/to_string.h"
#include "bakers/math/facts.h"
#include "bakers/math/hash.h"
#include "bakers/plan/bake_ways.h"
#include "bakers/plan/found_sky.h"
#include "bakers/plan/kept_figures.h"
#include "bakers/plan/sky_sheet.h"
#include "bakers/plan/sky_truth.h"
#include "config/assets/asset_kind.h"

namespace skybake {

using config::Outcome;
using config::Recipe;

namespace {

constexpr int kViews = 192;

std::optional<config::Diagnostic> obstacle(const config::Parameters& parameters) {
    if (!(parameters.atmosphere.top_radius.meters > 0)) {
        config::Diagnostic problem;
        problem.code = "E0105";
        problem.message = "the recipe has no [atmosphere] and so no sky";
        return problem;
    }
    if (parameters.wavelengths.size() <= kMaxChannels) return std::nullopt;
    config::Diagnostic problem;
    problem.code = "E0147";
    problem.message =
        fmt::format("`plan` compares skies of at most four wavelengths; the recipe has {}",
                    parameters.wavelengths.size());
    problem.label = "--set 'wavelengths=\"best 4\"' takes four";
    return problem;
}

// Only sky views are left out, and those by their suns.
config::Diagnostic no_ways(std::size_t suns) {
    config::Diagnostic problem;
    problem.code = suns == 0 ? "E0105" : "E0110";
    problem.message = fmt::format(
        "`sky_by` allows nothing but sky views, which `plan` compares for one to {} suns; the "
        "scene "
        "has {}",
        kMostViewedSuns, suns);
    problem.label = "state `suns` in [scene], or allow \"march\" or \"fetch\" too";
    return problem;
}

WayLimits limits_of(const PlanRequest& request, const config::Scene& scene) {
    WayLimits limits = request.limits;
    if (!limits.error) limits.error = scene.max_sky_error;
    if (!limits.fetches) limits.fetches = scene.max_fetches;
    if (!limits.bytes && scene.max_size_mib) limits.bytes = *scene.max_size_mib * 1024 * 1024;
    return limits;
}

// A recipe with all that the ways need.
struct PlannedScene {
    Recipe recipe;
    SceneRange range;
    std::vector<SkyWay> ways;
};

// Reads the recipe's scene, or one that says nothing.
Outcome<Recipe> load_scene(const PlanRequest& request, std::vector<std::string>& settings) {
    Outcome<Recipe> recipe = request.load(settings);
    if (!recipe.value || recipe.value->parameters.scene) return recipe;
    settings.emplace_back("scene.view_distance=\"64 km\"");  // its default
    return request.load(settings);
}

Outcome<PlannedScene> planned_scene(const PlanRequest& request) {
    std::vector<std::string> settings;
    Outcome<Recipe> recipe = load_scene(request, settings);
    if (!recipe.value) return {{}, std::move(recipe.diagnostics)};
    const config::Parameters& parameters = recipe.value->parameters;
    if (auto problem = obstacle(parameters)) return {{}, {std::move(*problem)}};
    PlannedScene scene;
    scene.range = range_of(*parameters.scene, shell_of(parameters.atmosphere));
    std::vector<std::string> suns;
    for (const double sun_deg : scene.range.suns_deg)
        suns.push_back(fmt::format("\"{} deg\"", sun_deg));
    const double middle_km = (scene.range.lowest_altitude_km + scene.range.highest_altitude_km) / 2;
    scene.ways = sky_ways(parameters.scene->sky_by, suns, fmt::format("\"{} km\"", middle_km));
    if (scene.ways.empty()) return {{}, {no_ways(scene.range.suns_deg.size())}};
    scene.recipe = std::move(*recipe.value);
    return {std::move(scene), {}};
}

// Reads the recipe again with the assets of all ways.
Outcome<Recipe> load_assets(const PlanRequest& request, const WayAssets& assets) {
    std::vector<std::string> settings;
    const Outcome<Recipe> scene = load_scene(request, settings);
    for (std::string& setting : assets.settings()) settings.push_back(std::move(setting));
    return request.load(settings);
}

// The weights of colours, if tables of light hold colours; any asset of light states them.
std::vector<glm::dvec3> weights_of(const config::Parameters& parameters,
                                   const std::vector<BakedAsset>& assets) {
    const auto stated = std::find_if(assets.begin(), assets.end(), [](const BakedAsset& asset) {
        return asset.baked.conventions.color.has_value();
    });
    if (!holds_colors(parameters) || stated == assets.end()) return {};
    return weights_of(*stated->baked.conventions.color);
}

// Raise it whenever the same parameters give other figures and no baker's version tells so.
constexpr int kVersion = 1;

// Tells all that the figures of ways depend on.
std::string key_of(const Recipe& recipe, const WayAssets& assets, const PlannedScene& scene,
                   const std::vector<SkySample>& views, double paths) {
    std::string text = fmt::format("version {}, {} paths\n", kVersion, paths);
    for (const AnyBaker& baker : bakers())
        text += fmt::format("{} {}\n", baker.asset, baker.version);
    std::vector<config::Read> reads =
        config::reads_of_light(recipe.parameters, config::Roles::all());
    reads.push_back({"scene", {config::Role::content}});  // limits are no part of it
    text += config::parameters_toml(recipe, reads);
    for (const std::string& setting : assets.settings()) text += setting + '\n';
    for (const SkyWay& way : scene.ways) text += fmt::format("{}, {}\n", way.family, way.name);
    for (const SkySample& view : views) {
        text += fmt::format("{} {} {} {}\n", view.altitude_km, view.sun_elevation_deg,
                            view.above_horizon_deg, view.azimuth_deg);
    }
    return xxh3_hex(text);
}

// Measures a way in the truth's views.
void measure_way(const SkyOfWay& sky, const SceneTruth& truth, const WayAssets& assets,
                 const std::vector<BakedAsset>& baked, MeasuredWay& measured) {
    const std::vector<const BakedAsset*> own = assets.of(measured.way, baked);
    for (const BakedAsset* asset : own) {
        measured.figures.bytes += texture_bytes(asset->baked);
        measured.bake_s += asset->seconds;
    }
    measured.error = truth.error(sky.find(measured.way, own, measured.figures.fetches));
    measured.figures.error = to_digits(measured.error.ninth_decile, 2);
}

// Measures the ways of a scene in views of it that begin with number `first`, and draws their sheet.
Outcome<KeptPlan> measure(const PlanRequest& request, const PlannedScene& scene,
                          std::uint32_t first) {
    const WayAssets assets(scene.ways);
    const Outcome<Recipe> recipe = load_assets(request, assets);
    if (!recipe.value) return {{}, recipe.diagnostics};
    const config::Parameters& parameters = recipe.value->parameters;
    std::vector<SkySample> views =
        scene_views(scene.range, shell_of(parameters.atmosphere), kViews, first);
    KeptPlan plan;
    for (const SkyWay& way : scene.ways) plan.ways.push_back({way, {}, {}});
    const std::string key = key_of(*recipe.value, assets, scene, views, request.paths);
    if (find_figures(request.cache, key, plan)) return {std::move(plan), {}};
    const BakeOptions options{.threads = request.threads, .progress = request.progress};
    const Outcome<std::vector<BakedAsset>> baked = bake_ways(*recipe.value, assets, options);
    if (!baked.value) return {{}, baked.diagnostics};
    const std::vector<glm::dvec3> weights = weights_of(parameters, *baked.value);
    SceneTruth truth(parameters.atmosphere, std::move(views), weights, options);
    truth.trace(request.paths);
    const SkyOfWay sky(parameters, truth, request.threads);
    for (MeasuredWay& way : plan.ways) measure_way(sky, truth, assets, *baked.value, way);
    auto sheet =
        sky_sheet(*recipe.value, scene.range, plan.ways, assets, *baked.value, weights, options);
    if (options.cancelled() || !sheet.value) return {{}, std::move(sheet.diagnostics)};
    plan.sheet = std::move(*sheet.value);
    std::vector<config::Diagnostic> problems = keep_figures(request.cache, key, plan);
    return {std::move(plan), std::move(problems)};
}

std::vector<WayFigures> figures_of(const std::vector<MeasuredWay>& ways) {
    std::vector<WayFigures> figures;
    for (const MeasuredWay& way : ways) figures.push_back(way.figures);
    return figures;
}

// Says which figures the best ways reach.
config::Diagnostic unreached(const std::vector<WayFigures>& figures) {
    WayFigures least = figures.front();
    for (const WayFigures& way : figures) {
        least.error = std::min(least.error, way.error);
        least.fetches = std::min(least.fetches, way.fetches);
        least.bytes = std::min(least.bytes, way.bytes);
    }
    config::Diagnostic problem;
    problem.code = "E0408";
    problem.message = fmt::format(
        "no way to draw the sky keeps the limits; each by itself, the least error is {:.3g} %, the "
        "fewest fetches are {:.0f} and the least size is {}",
        100 * least.error, least.fetches, byte_size_text(least.bytes));
    problem.label = "raise a limit; the table shows what each way has";
    return problem;
}

// Returns E0409 where no path finds light enough to tell an error, as at night.
std::optional<config::Diagnostic> darkness(const SkyError& error) {
    if (error.points > 0 || error.left_out == 0) return std::nullopt;
    config::Diagnostic problem;
    problem.code = "E0409";
    problem.message = "paths of light find too little light in this scene to compare skies with";
    problem.label = "raise the suns of [scene], or its cameras above dense air";
    return problem;
}

}  // namespace

Outcome<SkyPlan> plan_sky(const PlanRequest& request) {
    Outcome<PlannedScene> scene = planned_scene(request);
    if (!scene.value) return {{}, std::move(scene.diagnostics)};
    Outcome<KeptPlan> measured = measure(request, *scene.value, 1);
    Outcome<SkyPlan> outcome;
    outcome.diagnostics = std::move(measured.diagnostics);
    if (!measured.value) return outcome;
    SkyPlan plan;
    plan.range = scene.value->range;
    plan.limits = limits_of(request, *scene.value->recipe.parameters.scene);
    plan.ways = std::move(measured.value->ways);
    plan.sheet = std::move(measured.value->sheet);
    const SkyError& of_first = plan.ways.front().error;
    if (auto problem = darkness(of_first)) return {{}, {std::move(*problem)}};
    plan.reference = of_first.reference;
    const std::vector<WayFigures> figures = figures_of(plan.ways);
    const std::vector<bool> front = front_of(figures);
    for (std::size_t i = 0; i < front.size(); ++i) plan.ways[i].on_front = front[i];
    plan.knee = knee_of(figures);
    plan.has_colors = holds_colors(scene.value->recipe.parameters);
    const auto best = best_within(plan.limits, figures, of_first.standard_error);
    plan.keeps_limits = best.has_value();
    if (!best) outcome.diagnostics.push_back(unreached(figures));
    plan.chosen = !plan.limits.any() ? plan.knee : best.value_or(*best_within({}, figures, 0));
    if (of_first.left_out > 0) {
        plan.notes.push_back(
            fmt::format("{} of {} values are left out: paths find too little light there",
                        of_first.left_out, of_first.left_out + of_first.points));
    }
    const std::size_t suns = plan.range.suns_deg.size();
    if (suns == 0 || suns > kMostViewedSuns) {
        plan.notes.push_back(fmt::format(
            "sky views are left out: they are compared for one to {} suns (`suns` in [scene])",
            kMostViewedSuns));
    }
    outcome.value = std::move(plan);
    return outcome;
}

Outcome<SkyError> judge_way(const PlanRequest& request, const SkyWay& way, std::uint32_t first) {
    Outcome<PlannedScene> scene = planned_scene(request);
    if (!scene.value) return {{}, std::move(scene.diagnostics)};
    scene.value->ways = {way};
    Outcome<KeptPlan> measured = measure(request, *scene.value, first);
    if (!measured.value) return {{}, std::move(measured.diagnostics)};
    return {measured.value->ways.front().error, std::move(measured.diagnostics)};
}

}  // namespace skybake
