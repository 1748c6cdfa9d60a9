#include "bakers/plan/plan.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "bakers/assets/cloud_volume/cloud_volume.h"
#include "bakers/math/facts.h"
#include "bakers/plan/bake_ways.h"
#include "bakers/plan/cloud_sheet.h"
#include "bakers/plan/cloud_truth.h"
#include "bakers/plan/cloud_ways.h"
#include "bakers/plan/sheet_pictures.h"
#include "config/assets/asset_kind.h"

namespace skybake {
namespace {

constexpr int kCloudViews = 768;
constexpr double kCloudPaths = 3 << 17;
constexpr int kUsualVoxels = 256;  // along the longest edge
constexpr double kMostVoxels = 1 << 25;

// Raise it whenever the same parameters give other figures and no baker's version tells so.
constexpr int kVersionOfClouds = 2;

const CloudVolumeBake* volume_of(const Parameters& parameters, const std::string& cloud) {
    for (const Bake& bake : parameters.bakes) {
        const auto* volume = bake.find<CloudVolumeBake>();
        if (volume != nullptr && volume->cloud == cloud) return volume;
    }
    return nullptr;
}

std::array<int, 3> usual_size(const Cloud& cloud) {
    const double longest_m =
        std::max({cloud.extent[0].meters, cloud.extent[1].meters, cloud.extent[2].meters});
    std::array<int, 3> size{};
    for (std::size_t a = 0; a < 3; ++a) {
        size[a] = std::max(
            1, static_cast<int>(std::lround(kUsualVoxels * cloud.extent[a].meters / longest_m)));
    }
    return size;
}

// A cloud of a recipe, with all that its ways need.
struct PlannedCloud {
    Recipe recipe;
    CloudSubject subject;
    CloudRange range;
    std::vector<CloudWay> ways;
    std::vector<std::string> notes;
};

CloudSubject subject_of(const Cloud& cloud, const CloudVolumeBake* volume,
                        std::vector<std::string>& notes) {
    CloudSubject subject;
    subject.cloud = cloud.name;
    subject.size = volume != nullptr ? volume->size : usual_size(cloud);
    while (voxels_of(subject.size, 1) > kMostVoxels) {
        for (int& edge : subject.size) edge = std::max(1, edge / 2);
    }
    if (volume != nullptr && subject.size != volume->size) {
        notes.push_back(fmt::format("planned with {} voxels, since {} are more than {:.0f} million",
                                    fmt::join(subject.size, "x"), fmt::join(volume->size, "x"),
                                    kMostVoxels / 1e6));
    }
    if (volume != nullptr && volume->cover) subject.cover = fmt::format("{}", *volume->cover);
    return subject;
}

Outcome<PlannedCloud> planned_cloud(const PlanRequest& request, const std::string& name) {
    Outcome<Recipe> recipe = load_scene(request);
    if (!recipe.value) return {{}, std::move(recipe.diagnostics)};
    const Parameters& parameters = recipe.value->parameters;
    PlannedCloud planned;
    const CloudVolumeBake* volume = volume_of(parameters, name);
    Cloud cloud = config::cloud_named(parameters, name);
    if (volume != nullptr) cloud = spanned_cloud(parameters, *volume);
    planned.subject = subject_of(cloud, volume, planned.notes);
    planned.range = cloud_range(*parameters.scene, cloud);
    if (planned.range.has_own_suns) {
        for (const double sun_deg : planned.range.suns_deg)
            planned.subject.suns.push_back(fmt::format("\"{} deg\"", sun_deg));
    }
    if (planned.subject.suns.empty() || planned.subject.suns.size() > kMostLitSuns) {
        planned.notes.push_back(
            fmt::format("depths and radiance for each sun are left out: they are compared for one "
                        "to {} suns (`suns` in [scene])",
                        kMostLitSuns));
    }
    planned.ways = cloud_ways(planned.subject);
    std::erase_if(planned.ways, [&](const Way& way) { return request.leaves_out(way); });
    planned.recipe = std::move(*recipe.value);
    return {std::move(planned), {}};
}

// Ways that differ in their cells alone show the same: this leaves the one of fewest fetches and says
// what its leaps save.
void keep_best_cells(const std::vector<CloudWay>& ways, MeasuredWays& measured) {
    std::map<std::string, std::size_t> best;
    std::map<std::string, double> without;
    for (std::size_t i = 0; i < ways.size(); ++i) {
        const auto cost = [&](std::size_t n) {
            const WayFigures& figures = measured.ways[n].figures;
            return std::tuple(std::llround(figures.fetches), figures.operations, figures.bytes);
        };
        const auto [least, is_first] = best.try_emplace(ways[i].drawing, i);
        if (cost(i) < cost(least->second)) least->second = i;
        if (ways[i].cell == 0) without[ways[i].drawing] = measured.ways[i].figures.fetches;
    }
    std::vector<MeasuredWay> kept;
    for (std::size_t i = 0; i < ways.size(); ++i) {
        if (best.at(ways[i].drawing) != i) continue;
        kept.push_back(std::move(measured.ways[i]));
        Way& way = kept.back().way;
        if (ways[i].cell > 0) {
            way.name += fmt::format(" ({:.0f} fetches without)", without.at(ways[i].drawing));
        }
    }
    measured.ways = std::move(kept);
}

MeasuredWay measured_way(const CloudTruth& truth, const CloudWay& way, const FoundCloud& found,
                         const std::vector<const BakedAsset*>& own) {
    MeasuredWay measured = costed(way, own);
    double rms = 0;
    measured.error = truth.error(found.radiance, rms);
    measured.figures.error = to_digits(rms, 2);
    add_lookups(*own[0], found.densities + found.lit * way.sun_samples, measured.figures);
    if (way.cell > 0) add_lookups(*own[1], found.cells, measured.figures);
    // Textures of one sun: the others have as many.
    const std::size_t end =
        way.per_sun == 0 ? own.size() : way.first + way.per_sun + (way.degree > 0 ? 1 : 0);
    for (std::size_t i = way.first; way.first > 0 && i < end; ++i) {
        add_lookups(*own[i], found.lit, measured.figures);
    }
    return measured;
}

// Measures the ways of a cloud in views of the scene, and draws their sheet.
Outcome<MeasuredWays> measure(const PlanRequest& request, const PlannedCloud& planned) {
    const std::uint32_t first = request.first_view();
    std::vector<Way> all(planned.ways.begin(), planned.ways.end());
    all.push_back(traced_cloud(planned.subject));
    const WayAssets assets(all);
    const Outcome<Recipe> recipe = load_scene(request, assets.settings());
    if (!recipe.value) return {{}, recipe.diagnostics};
    MeasuredWays plan;
    for (const CloudWay& way : planned.ways) plan.ways.push_back({way, {}, {}});
    const double paths = request.paths > 0 ? request.paths : kCloudPaths;
    const std::string key = figures_key(
        *recipe.value, config::reads_of_cloud(recipe.value->parameters, planned.subject.cloud),
        assets, plan,
        fmt::format("cloud, version {}, {} paths, views from {}, {}\n", kVersionOfClouds, paths,
                    first, fmt::join(planned.range.suns_deg, " ")));
    if (find_figures(request.cache, key, plan)) return {std::move(plan), {}};
    const BakeOptions options{.threads = request.threads, .progress = request.progress};
    const Outcome<std::vector<BakedAsset>> baked = bake_ways(*recipe.value, assets, options);
    if (!baked.value) return {{}, baked.diagnostics};
    const Parameters& parameters = recipe.value->parameters;
    const BakedAsset& finest = *assets.of(all.back(), *baked.value).front();
    const Cloud cloud = spanned_cloud(parameters, finest.bake->as<CloudVolumeBake>());
    const cloud_light::CloudLayer layer = cloud_light::make_layer(finest.baked, 0, cloud, options);
    CloudTruth truth(layer, planned.range, cloud_views(planned.range, kCloudViews, first), options);
    truth.trace(paths);
    if (options.cancelled()) return {};
    CloudOfWay clouds(cloud, truth, options);
    for (std::size_t i = 0; i < planned.ways.size(); ++i) {
        const CloudWay& way = planned.ways[i];
        const auto own = assets.of(way, *baked.value);
        plan.ways[i] = measured_way(truth, way, clouds.find(way, own), own);
        if (options.cancelled()) return {};
    }
    if (request.judged != nullptr) return {std::move(plan), {}};
    std::vector<BakedWay<CloudWay>> best;
    for (const std::size_t i : best_of_families(plan.ways)) {
        best.push_back({&planned.ways[i], assets.of(planned.ways[i], *baked.value)});
    }
    auto sheet = cloud_sheet(cloud, layer, planned.range, best, options);
    if (options.cancelled() || !sheet.value) return {{}, std::move(sheet.diagnostics)};
    plan.sheet = std::move(*sheet.value);
    std::vector<Diagnostic> problems = keep_figures(request.cache, key, plan);
    return {std::move(plan), std::move(problems)};
}

ErrorWords cloud_words() {
    ErrorWords words;
    words.compared = "RMS of the picture (% of white)";
    words.claim = "off by {} % of white (RMS)";
    words.column = "RMS %";
    words.meaning =
        "of the sunlit cloud's picture, in % of white: in the median, the RMS without the paths' "
        "noise, and the largest";
    return words;
}

}  // namespace

Outcome<Plan> plan_cloud(const PlanRequest& request, const std::string& name) {
    Outcome<PlannedCloud> planned = planned_cloud(request, name);
    if (!planned.value) return {{}, std::move(planned.diagnostics)};
    const CloudRange& range = planned.value->range;
    Plan plan;
    plan.subject = {config::Draws::clouds, name};
    if (range.suns_deg.empty()) return without_light(plan.subject);
    Outcome<MeasuredWays> measured = measure(request, *planned.value);
    if (!measured.value) return {{}, std::move(measured.diagnostics)};
    const Parameters& parameters = planned.value->recipe.parameters;
    plan.scene = fmt::format("cameras from {:.3g} to {:.3g} km, suns at {:.3g} degrees",
                             range.lowest_altitude_m / 1000, range.highest_altitude_m / 1000,
                             fmt::join(range.suns_deg, ", "));
    plan.words = cloud_words();
    plan.reads = config::reads_of_cloud(parameters, name);
    plan.limits = limits_of(request, *parameters.scene, parameters.scene->max_cloud_error);
    if (request.judged == nullptr) keep_best_cells(planned.value->ways, *measured.value);
    plan.ways = std::move(measured.value->ways);
    plan.sheet = std::move(measured.value->sheet);
    plan.notes = std::move(planned.value->notes);
    return chosen(std::move(plan), std::move(measured.diagnostics));
}

}  // namespace skybake
