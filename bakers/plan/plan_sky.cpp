#include "bakers/plan/plan_sky.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "bakers/math/facts.h"
#include "bakers/math/hash.h"
#include "bakers/plan/bake_ways.h"
#include "bakers/plan/kept_figures.h"
#include "bakers/plan/plan_files.h"
#include "bakers/plan/sheet_pictures.h"
#include "bakers/plan/sky_sheet.h"
#include "bakers/plan/sky_truth.h"
#include "bakers/plan/sky_ways.h"
#include "config/assets/asset_kind.h"

namespace skybake {
namespace {

constexpr int kViews = 192;
constexpr double kPaths = 3 << 19;

std::optional<Diagnostic> obstacle(const Parameters& parameters) {
    if (!(parameters.atmosphere.top_radius.meters > 0)) {
        Diagnostic problem;
        problem.code = "E0105";
        problem.message = "the recipe has no [atmosphere] and so no sky";
        return problem;
    }
    if (parameters.wavelengths.size() <= kMaxChannels) return std::nullopt;
    Diagnostic problem;
    problem.code = "E0147";
    problem.message =
        fmt::format("`plan` compares skies of at most four wavelengths; the recipe has {}",
                    parameters.wavelengths.size());
    problem.label = "--set 'wavelengths=\"best 4\"' takes four";
    return problem;
}

// Only sky views are left out, and those by their suns.
Diagnostic no_ways(std::size_t suns) {
    Diagnostic problem;
    problem.code = suns == 0 ? "E0105" : "E0110";
    problem.message = fmt::format(
        "`sky_by` allows nothing but sky views, which `plan` compares for one to {} suns; the "
        "scene has {}",
        kMostViewedSuns, suns);
    problem.label = "state `suns` in [scene], or allow \"march\" or \"fetch\" too";
    return problem;
}

// A recipe with all that the ways need.
struct PlannedScene {
    Recipe recipe;
    SceneRange range;
    std::vector<SkyWay> ways;
};

Outcome<PlannedScene> planned_scene(const PlanRequest& request) {
    Outcome<Recipe> recipe = load_scene(request);
    if (!recipe.value) return {{}, std::move(recipe.diagnostics)};
    const Parameters& parameters = recipe.value->parameters;
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

// The weights of colours, if tables of light hold colours; any asset of light states them.
std::vector<glm::dvec3> weights_of(const Parameters& parameters,
                                   const std::vector<BakedAsset>& assets) {
    const auto stated = std::ranges::find_if(
        assets, [](const BakedAsset& asset) { return asset.baked.conventions.color.has_value(); });
    if (!holds_colors(parameters) || stated == assets.end()) return {};
    return weights_of(*stated->baked.conventions.color);
}

// Raise it whenever the same parameters give other figures and no baker's version tells so.
constexpr int kVersion = 2;

// Tells all that the figures of ways depend on.
std::string key_of(const Recipe& recipe, const WayAssets& assets, const PlannedScene& scene,
                   const std::vector<SkySample>& views, double paths) {
    std::string text = fmt::format("version {}, {} paths\n", kVersion, paths);
    text += versions_of_bakers();
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
MeasuredWay measure_way(const SkyOfWay& sky, const SceneTruth& truth, const SkyWay& way,
                        const std::vector<const BakedAsset*>& own) {
    MeasuredWay measured = costed(way, own);
    measured.error = truth.error(sky.find(way, own, measured.figures.fetches));
    measured.figures.error = to_digits(measured.error.ninth_decile, 2);
    return measured;
}

// Measures the ways of a scene in views of it that begin with number `first`, and draws their sheet.
Outcome<MeasuredWays> measure(const PlanRequest& request, const PlannedScene& scene,
                              std::uint32_t first, Sheets sheets) {
    const WayAssets assets(scene.ways);
    const Outcome<Recipe> recipe = load_scene(request, assets.settings());
    if (!recipe.value) return {{}, recipe.diagnostics};
    const Parameters& parameters = recipe.value->parameters;
    std::vector<SkySample> views =
        scene_views(scene.range, shell_of(parameters.atmosphere), kViews, first);
    MeasuredWays plan;
    for (const SkyWay& way : scene.ways) plan.ways.push_back({way, {}, {}});
    const double paths = request.paths > 0 ? request.paths : kPaths;
    const std::string key = key_of(*recipe.value, assets, scene, views, paths);
    if (find_figures(request.cache, key, plan)) return {std::move(plan), {}};
    const BakeOptions options{.threads = request.threads, .progress = request.progress};
    const Outcome<std::vector<BakedAsset>> baked = bake_ways(*recipe.value, assets, options);
    if (!baked.value) return {{}, baked.diagnostics};
    const std::vector<glm::dvec3> weights = weights_of(parameters, *baked.value);
    SceneTruth truth(parameters.atmosphere, std::move(views), weights, options);
    truth.trace(paths);
    const SkyOfWay sky(parameters, truth, request.threads);
    for (std::size_t i = 0; i < scene.ways.size(); ++i) {
        const SkyWay& way = scene.ways[i];
        plan.ways[i] = measure_way(sky, truth, way, assets.of(way, *baked.value));
    }
    if (sheets == Sheets::none) return {std::move(plan), {}};
    std::vector<BakedWay<SkyWay>> best;
    for (const std::size_t i : best_of_families(plan.ways)) {
        best.push_back({&scene.ways[i], assets.of(scene.ways[i], *baked.value)});
    }
    auto sheet = sky_sheet(parameters, scene.range, best, weights, options);
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
    std::vector<std::string> suns;
    for (const double sun : range.suns_deg) suns.push_back(fmt::format("{:.3g}", sun));
    return fmt::format("suns at {} degrees", fmt::join(suns, ", "));
}

ErrorWords words_of(bool has_colors) {
    ErrorWords words;
    words.compared = "sky error, ninth decile (%)";
    words.claim = "at most {} % off in nine of ten views";
    words.column = "9 in 10 %";
    words.meaning = fmt::format(
        "of {} against paths of light, in the median, in nine of ten views, and the largest",
        has_colors ? "colours" : "radiance");
    words.remark =
        "# A bake's own error.sky is larger: it looks where skies are hardest, not evenly.\n";
    return words;
}

}  // namespace

Outcome<Plan> plan_sky(const PlanRequest& request) {
    Outcome<PlannedScene> scene = planned_scene(request);
    if (!scene.value) return {{}, std::move(scene.diagnostics)};
    Outcome<MeasuredWays> measured = measure(request, *scene.value, 1, Sheets::drawn);
    if (!measured.value) return {{}, std::move(measured.diagnostics)};
    const Parameters& parameters = scene.value->recipe.parameters;
    const SceneRange& range = scene.value->range;
    Plan plan;
    plan.scene = fmt::format("cameras from {:.3g} to {:.3g} km, {}", range.lowest_altitude_km,
                             range.highest_altitude_km, suns_text(range));
    plan.words = words_of(holds_colors(parameters));
    plan.reads = config::reads_of_light(parameters, config::Roles::all());
    plan.limits = limits_of(request, *parameters.scene, parameters.scene->max_sky_error);
    plan.ways = std::move(measured.value->ways);
    plan.sheet = std::move(measured.value->sheet);
    if (range.suns_deg.empty() || range.suns_deg.size() > kMostViewedSuns) {
        plan.notes.push_back(fmt::format(
            "sky views are left out: they are compared for one to {} suns (`suns` in [scene])",
            kMostViewedSuns));
    }
    return chosen(std::move(plan), std::move(measured.diagnostics));
}

Outcome<SkyError> judge_sky(const PlanRequest& request, const Way& way, std::uint32_t first) {
    Outcome<PlannedScene> scene = planned_scene(request);
    if (!scene.value) return {{}, std::move(scene.diagnostics)};
    std::erase_if(scene.value->ways,
                  [&](const SkyWay& other) { return full_name(other) != full_name(way); });
    Outcome<MeasuredWays> measured = measure(request, *scene.value, first, Sheets::none);
    if (!measured.value) return {{}, std::move(measured.diagnostics)};
    return {measured.value->ways.front().error, std::move(measured.diagnostics)};
}

}  // namespace skybake
