// Whether a plan is honest: the way that it chooses for random scenes, judged in other views by other
// paths. The bar is a judged error of at most 1.3 times the one that the plan claims, in nine of ten
// scenes.
//
//   plan_benchmark [SCENES [FIRST]] [distance|ground_light|surroundings|clouds]
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <functional>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bakers/plan/plan.h"
#include "bakers/plan/plan_files.h"
#include "config/recipe/recipe.h"

namespace skybake {
namespace {

struct RandomScene {
    std::string text;
    double max_error = 0;  // 0: none, so that the plan takes the knee
};

// Numbers spread evenly.
double even(std::mt19937& engine, double low, double high) {
    return low + (high - low) * static_cast<double>(engine()) / 4294967296.0;
}

RandomScene random_scene(std::mt19937& engine) {
    const auto even = std::bind_front(skybake::even, std::ref(engine));
    constexpr std::array kPresets = {"earth", "earth_hillaire", "earth_bruneton", "mars_rgb"};
    const std::string preset = kPresets[engine() % kPresets.size()];
    const double lowest_km = even(0, 2);
    const double lowest_deg = even(-6, 30);
    RandomScene scene;
    scene.text = fmt::format(
        "preset = \"{}\"\n[atmosphere]\nground_albedo = {}\n[scene]\naltitude = [\"{} km\", \"{} "
        "km\"]\n",
        preset, even(0, 0.8), lowest_km, lowest_km + even(0, 8));
    if (engine() % 2 == 0) {
        scene.text += fmt::format("sun_elevation = [\"{} deg\", \"{} deg\"]\n", lowest_deg,
                                  lowest_deg + even(5, 60));
    } else {
        scene.text += fmt::format("suns = [\"{} deg\", \"{} deg\"]\n", lowest_deg, even(2, 80));
    }
    if (preset == "earth") {
        scene.text += fmt::format("[atmosphere.layers.aerosol]\noptical_depth = {}\ng = {}\n",
                                  even(0.02, 0.6), even(0.5, 0.8));
    }
    if (engine() % 2 == 0) scene.max_error = even(0.015, 0.1);
    return scene;
}

RandomScene random_clouds(std::mt19937& engine) {
    const auto even = std::bind_front(skybake::even, std::ref(engine));
    constexpr std::array kPresets = {"cumulus_humilis", "cumulus_mediocris", "stratocumulus",
                                     "altocumulus"};
    const double highest_km = even(0.2, 4);
    RandomScene scene;
    scene.text = fmt::format(
        "[scene]\naltitude = [\"0 km\", \"{} km\"]\nview_distance = \"30 km\"\n"
        "suns = [\"{} deg\"]\n[clouds.c]\npreset = \"{}\"\n"
        "[bake.c]\nasset = \"cloud_volume\"\ncloud = \"c\"\nsize = [128, 128, 32]\n",
        highest_km, even(5, 80), kPresets[engine() % kPresets.size()]);
    if (engine() % 2 == 0) scene.max_error = even(0.03, 0.2);
    return scene;
}

int run(std::uint32_t scenes, std::uint32_t first, config::Draws draws) {
    const bool clouds = draws == config::Draws::clouds;
    std::vector<double> ratios;
    for (std::uint32_t i = first; i < first + scenes; ++i) {
        std::mt19937 engine(i);
        const RandomScene scene = clouds ? random_clouds(engine) : random_scene(engine);
        PlanRequest request;
        request.load = [&](std::span<const std::string> settings) {
            return config::parse_recipe(scene.text, "scene", {}, settings);
        };
        if (scene.max_error > 0) request.limits.error = scene.max_error;
        const auto planned = [&] {
            return clouds ? plan_cloud(request, "c") : plan_light(request, draws);
        };
        const auto plan = planned();
        if (!plan.value) {
            fmt::print("{}: {}\n", i, plan.diagnostics.front().message);
            continue;
        }
        const MeasuredWay& chosen = plan.value->ways[plan.value->chosen];
        request.judged = &chosen.way;
        const MeasuredWay again = planned().value->ways.front();
        const double judged = clouds ? again.figures.error : again.error.ninth_decile;
        ratios.push_back(judged / chosen.figures.error);
        fmt::print("{}: limit {:.2g}, {}: claimed {:.2g}, judged {:.2g}, ratio {:.2f}\n", i,
                   scene.max_error, full_name(chosen.way), chosen.figures.error, judged,
                   ratios.back());
        std::fflush(stdout);
    }
    std::sort(ratios.begin(), ratios.end());
    if (!ratios.empty()) {
        fmt::print("ninth decile of the ratio: {:.2f}\n", ratios[ratios.size() * 9 / 10]);
    }
    return 0;
}

}  // namespace
}  // namespace skybake

int main(int argc, char** argv) {
    using enum skybake::config::Draws;
    skybake::config::Draws draws = sky;
    for (const auto& [word, one] : {std::pair("distance", distance),
                                    {"ground_light", ground_light},
                                    {"surroundings", surroundings},
                                    {"clouds", clouds}}) {
        if (std::string_view(argv[argc - 1]) == word) draws = one;
    }
    const auto number = [&](int i, std::uint32_t usual) {
        return argc - (draws == sky ? 0 : 1) > i ? static_cast<std::uint32_t>(std::atoi(argv[i]))
                                                 : usual;
    };
    return skybake::run(number(1, 20), number(2, 1), draws);
}
