#include "bakers/plan/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <string_view>
#include <utility>

#include "bakers/io/files/to_string.h"
#include "bakers/plan/plan_files.h"
#include "config/sections/cloud.h"
#include "config/text/mapped.h"

namespace skybake {

// The name of a way of clouds is followed by what its cells save.
bool PlanRequest::leaves_out(const Way& way) const {
    return judged != nullptr &&
           (way.assets != judged->assets || !full_name(*judged).starts_with(full_name(way)));
}

Outcome<Recipe> load_scene(const PlanRequest& request, const std::vector<std::string>& settings) {
    Outcome<Recipe> recipe = request.load(settings);
    if (!recipe.value || recipe.value->parameters.scene) return recipe;
    std::vector<std::string> all = settings;
    all.emplace_back("scene.view_distance=\"64 km\"");  // its default
    return request.load(all);
}

namespace {

// A part of the light of clear air.
struct Light {
    config::Draws draws;
    std::string_view word;
    std::string_view name;
};
constexpr Light kLights[] = {
    {config::Draws::sky, "sky", "the sky"},
    {config::Draws::distance, "distance", "the air before things"},
    {config::Draws::ground_light, "ground_light", "the light on the ground"},
    {config::Draws::surroundings, "surroundings", "the surroundings"},
};

const Light& light_of(const PlanSubject& subject) {
    return *std::ranges::find(kLights, subject.draws, &Light::draws);
}

// Says which figures the best ways reach.
Diagnostic unreached(const PlanSubject& subject, const std::vector<WayFigures>& figures) {
    WayFigures least = figures.front();
    for (const WayFigures& way : figures) {
        least.error = std::min(least.error, way.error);
        least.fetches = std::min(least.fetches, way.fetches);
        least.bytes = std::min(least.bytes, way.bytes);
    }
    return diagnosis(
        "E0408",
        fmt::format(
            "no way to draw {} keeps the limits; each by itself, the least error is {:.3g} %, the "
            "fewest fetches are {:.0f} and the least size is {}",
            name_of(subject), 100 * least.error, least.fetches, byte_size_text(least.bytes)),
        "raise a limit; the table shows what each way has");
}

}  // namespace

std::vector<PlanSubject> subjects_of(const Parameters& parameters) {
    const auto draws = [&](config::Draws what) {
        using enum config::Draws;
        if (!parameters.scene) return what == sky || what == clouds;
        const std::vector<config::Draws>& all = parameters.scene->draws;
        return std::ranges::find(all, what) != all.end();
    };
    std::vector<PlanSubject> subjects;
    for (const Light& light : kLights) {
        if (!draws(light.draws) || !(parameters.atmosphere.top_radius.meters > 0)) continue;
        subjects.push_back({light.draws, {}});
    }
    if (draws(config::Draws::clouds)) {
        for (const Cloud& cloud : parameters.clouds) {
            subjects.push_back({config::Draws::clouds, cloud.name});
        }
    }
    return subjects;
}

std::string name_of(const PlanSubject& subject) {
    if (subject.is_cloud()) return fmt::format("the cloud `{}`", subject.cloud);
    return std::string(light_of(subject).name);
}

std::string word_of(const PlanSubject& subject) {
    if (subject.is_cloud()) return "clouds." + subject.cloud;
    return std::string(light_of(subject).word);
}

WayLimits limits_of(const PlanRequest& request, const config::Scene& scene,
                    const std::optional<double>& max_error) {
    WayLimits limits = request.limits;
    if (!limits.error) limits.error = max_error;
    if (!limits.fetches) limits.fetches = scene.max_fetches;
    if (!limits.bytes && scene.max_size_mib) limits.bytes = *scene.max_size_mib * 1024 * 1024;
    return limits;
}

Outcome<Plan> without_light(const PlanSubject& subject) {
    return diagnosis(
        "E0409",
        fmt::format(
            "paths of light find too little light in this scene to compare ways to draw {} with",
            name_of(subject)),
        "raise the suns of [scene], or its cameras above dense air");
}

std::vector<std::size_t> by_error(const std::vector<MeasuredWay>& ways) {
    std::vector<std::size_t> sorted(ways.size());
    std::iota(sorted.begin(), sorted.end(), std::size_t{0});
    std::ranges::stable_sort(sorted, {}, [&](std::size_t i) { return ways[i].figures.error; });
    return sorted;
}

Outcome<Plan> chosen(Plan plan, std::vector<Diagnostic> diagnostics) {
    const SkyError& of_first = plan.ways.front().error;
    if (of_first.points == 0 && of_first.left_out > 0) return without_light(plan.subject);
    plan.reference = of_first.reference;
    const auto figures = mapped<WayFigures>(plan.ways, &MeasuredWay::figures);
    const std::vector<bool> front = front_of(figures);
    for (std::size_t i = 0; i < front.size(); ++i) plan.ways[i].on_front = front[i];
    plan.knee = knee_of(figures);
    const auto best = best_within(plan.limits, figures, of_first.standard_error);
    plan.keeps_limits = best.has_value();
    plan.chosen = !plan.limits.any() ? plan.knee : best.value_or(*best_within({}, figures, 0));
    if (of_first.left_out > 0) {
        plan.notes.push_back(
            fmt::format("{} of {} values are left out: paths find too little light there",
                        of_first.left_out, of_first.left_out + of_first.points));
    }
    if (!best) diagnostics.push_back(unreached(plan.subject, figures));
    return {std::move(plan), std::move(diagnostics)};
}

}  // namespace skybake
