#include "bakers/plan/plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "bakers/assets/registry/registry.h"
#include "bakers/plan/plan_files.h"
#include "tests/config/recipes.h"
#include "tests/support/cancelled_at.h"
#include "tests/support/outcomes.h"
#include "tests/support/refused.h"

namespace skybake {
namespace {

const std::string kScene =
    "preset = \"earth_hillaire\"\n[scene]\naltitude = [\"200 m\", \"400 m\"]\n"
    "suns = [\"40 deg\", \"8 deg\"]\nsky_by = [\"march\", \"picture\"]\n";

PlanRequest request_of(const std::string& text) {
    PlanRequest request;
    request.load = [text](std::span<const std::string> settings) {
        return config::parse_recipe(text, "scene", {}, settings);
    };
    request.paths = 1 << 17;
    return request;
}

Outcome<Plan> plan_sky(const PlanRequest& request) {
    return plan_light(request, config::Draws::sky);
}

// The plan of one scene for all tests that look at it.
const Plan& plan() {
    static const Plan plan = *plan_sky(request_of(kScene)).value;
    return plan;
}

double least_error(const std::string& family, const Plan& of = plan()) {
    double least = 1e9;
    for (const MeasuredWay& way : of.ways) {
        if (way.way.family == family) least = std::min(least, way.error.ninth_decile);
    }
    return least;
}

// More moments, and all orders in place of two, come nearer to the paths.
TEST(PlanSky, MoreOfTheLightIsNearerToThePaths) {
    EXPECT_LT(least_error("moments of degree 8"), 0.03);
    EXPECT_LT(least_error("moments of degree 8"), least_error("moments of degree 2"));
    EXPECT_LT(least_error("moments of degree 2"), least_error("mean radiance of all orders"));
    EXPECT_LT(least_error("mean radiance of all orders"), least_error("single scattering"));
    EXPECT_GT(least_error("single scattering"), 0.2);
    EXPECT_LT(least_error("sky views"), 0.05);
    EXPECT_EQ(least_error("scattering along rays"), 1e9) << "sky_by leaves them out";
}

TEST(PlanSky, EachWayHasWhatItCosts) {
    std::map<std::string, const MeasuredWay*> ways;
    for (const MeasuredWay& way : plan().ways) ways[full_name(way.way)] = &way;
    const MeasuredWay& moments = *ways.at("moments of degree 2, 64x64, half, 16 steps");
    EXPECT_EQ(moments.figures.fetches, 16 * (1 + 6));
    EXPECT_EQ(moments.figures.operations, 16 * (23 + 4 * 4 + 6 * (19 + 4)));
    EXPECT_EQ(moments.figures.bytes, 4 * 2 * (256 * 64 + 64 * 64 * 6));
    EXPECT_GT(moments.bake_s, 0);
    const MeasuredWay& alone = *ways.at("single scattering, 256x64, float, 8 steps");
    EXPECT_EQ(alone.figures.fetches, 8);
    EXPECT_EQ(alone.figures.bytes, 4 * 4 * 256 * 64);
    const MeasuredWay& picture = *ways.at("sky views, 192x108, half");
    EXPECT_EQ(picture.figures.fetches, 1);
    EXPECT_EQ(picture.figures.operations, 74 + 4 * 6);
    EXPECT_EQ(picture.figures.bytes, 4 * 2 * 192 * 108 * 2);
}

TEST(PlanSky, WithoutLimitsItTakesTheKnee) {
    EXPECT_EQ(plan().chosen, plan().knee);
    EXPECT_TRUE(plan().ways[plan().chosen].on_front);
}

TEST(PlanSky, TheRecipeBakesWhatWasChosen) {
    const auto scene = request_of(kScene).load({});
    const std::string text = planned_recipe({&plan(), 1}, *scene.value);
    const auto recipe = test::without_errors(config::parse_recipe(text, "planned"));
    const std::vector<config::Bake>& bakes = recipe.parameters.bakes;
    const Way& chosen = plan().ways[plan().chosen].way;
    ASSERT_EQ(bakes.size(), chosen.assets.size());
    for (std::size_t i = 0; i < bakes.size(); ++i) {
        EXPECT_EQ(bakes[i].name, chosen.assets[i].name);
        EXPECT_TRUE(bake_asset(recipe, bakes[i], {.certification = Certification::off}).value);
    }
}

TEST(PlanSky, FilesHaveAllWays) {
    const auto json = nlohmann::json::parse(plan_json({&plan(), 1}));
    EXPECT_EQ(json["subjects"][0]["ways"].size(), plan().ways.size());
    EXPECT_EQ(json["subjects"][0]["chosen"], plan().chosen);
    const std::string csv = plan_csv({&plan(), 1});
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), static_cast<long>(plan().ways.size()) + 1);
    const Figure figure = plan_figure(plan());
    ASSERT_EQ(figure.charts.size(), 2u);
    for (const Chart& chart : figure.charts) {
        EXPECT_EQ(chart.points.size(), plan().ways.size());
        EXPECT_EQ(std::count_if(chart.points.begin(), chart.points.end(),
                                [](const ChartPoint& point) { return point.label == "chosen"; }),
                  1);
    }
}

// A scene of one way, so that plans are quick.
const std::string kQuick =
    "preset = \"earth_hillaire\"\n[scene]\nsuns = [\"40 deg\"]\nsky_by = [\"picture\"]\n";

TEST(PlanSky, FiguresAreTakenFromTheCache) {
    const config::testing::TemporaryFolder folder;
    PlanRequest request = request_of(kQuick);
    request.paths = 1 << 12;
    request.cache = folder.path() / "cache";
    const auto first = test::without_errors(plan_sky(request));
    std::filesystem::path kept;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(request.cache)) {
        if (entry.path().extension() == ".json") kept = entry.path();
    }
    ASSERT_FALSE(kept.empty());
    const auto second = plan_sky(request);
    EXPECT_EQ(plan_json({&*second.value, 1}), plan_json({&first, 1})) << "times included";
    // Damaged figures, and those of another scene, are measured again.
    std::ofstream(kept, std::ios::app) << "x";
    const auto third = test::without_errors(plan_sky(request));
    EXPECT_EQ(third.ways[0].error.median, first.ways[0].error.median);
    request.load = request_of(kQuick + "[atmosphere]\nground_albedo = 0.8\n").load;
    const auto other = plan_sky(request);
    EXPECT_NE(other.value->ways[0].error.median, first.ways[0].error.median);
}

TEST(PlanSky, LimitsThatNothingKeepsNameTheBest) {
    PlanRequest request = request_of(kQuick);
    request.paths = 1 << 12;
    request.limits.error = 1e-6;
    const auto outcome = plan_sky(request);
    ASSERT_TRUE(outcome.value);
    ASSERT_EQ(outcome.diagnostics.size(), 1u);
    EXPECT_EQ(outcome.diagnostics[0].code, "E0408");
    EXPECT_NE(outcome.diagnostics[0].message.find("the fewest fetches are 1"), std::string::npos);
    const MeasuredWay& chosen = outcome.value->ways[outcome.value->chosen];
    for (const MeasuredWay& way : outcome.value->ways) {
        EXPECT_LE(chosen.figures.error, way.figures.error);
    }
}

const std::string kManyWavelengths =
    "preset = \"earth\"\nwavelengths = \"400 nm..700 nm by 50 nm\"\n";

TEST(PlanSky, NeedsAirAndFewWavelengthsOrColours) {
    test::expect_refused(plan_sky(request_of("format = 1\n")), "E0105");
    test::expect_refused(plan_sky(request_of(kManyWavelengths)), "E0147");
}

// Marches would need all wavelengths, so what holds colours is left, and is right.
TEST(PlanSky, ColoursOfManyWavelengthsHaveNoMarch) {
    PlanRequest request = request_of(kManyWavelengths +
                                     "color.space = \"linear_srgb\"\n[scene]\n"
                                     "suns = [\"40 deg\"]\naltitude = [\"0 km\", \"1 m\"]\n"
                                     "sky_by = [\"march\", \"picture\"]\n");
    const auto many = test::without_errors(plan_sky(request));
    for (const MeasuredWay& way : many.ways) EXPECT_EQ(way.way.by, "picture");
    EXPECT_LT(least_error("sky views", many), 0.05);
}

// Other parts of the light, in one scene.
Plan plan_of(config::Draws light) {
    PlanRequest request = request_of(
        "preset = \"earth_hillaire\"\n[scene]\naltitude = [\"500 m\", \"501 m\"]\n"
        "suns = [\"40 deg\", \"8 deg\"]\nview_distance = \"60 km\"\n");
    return *plan_light(request, light).value;
}

TEST(PlanLight, AirBeforeThingsIsMarchedOrReadFromVolumes) {
    const Plan plan = plan_of(config::Draws::distance);
    EXPECT_LT(least_error("moments of degree 8", plan), 0.03) << "700 paths of noise";
    EXPECT_LT(least_error("volumes of air", plan), 0.06);
    EXPECT_GT(least_error("single scattering", plan), 0.15);
    EXPECT_EQ(least_error("scattering along rays", plan), 1e9);
    const auto volume = std::ranges::find(plan.ways, "volumes of air",
                                          [](const MeasuredWay& way) { return way.way.family; });
    EXPECT_EQ(volume->way.assets.size(), 4u) << "two headings for each of two suns";
    EXPECT_EQ(volume->figures.bytes, 4 * 16 * 16 * 16 * 4 * 2);
    EXPECT_FALSE(plan.sheet.empty());
}

TEST(PlanLight, LightOnTheGroundIsOfSunAndSky) {
    const Plan plan = plan_of(config::Draws::ground_light);
    EXPECT_LT(least_error("light of sun and sky", plan), 0.02) << "700 paths of noise";
    EXPECT_GT(least_error("light of the sun alone", plan), 0.1);
    for (const MeasuredWay& way : plan.ways) EXPECT_EQ(way.figures.fetches, 1);
    EXPECT_TRUE(plan.sheet.empty());
    const auto colors = test::without_errors(plan_light(
        request_of("preset = \"earth_hillaire\"\ncolor = {}\n[scene]\nsuns = [\"20 deg\"]\n"),
        config::Draws::ground_light));
    EXPECT_LT(least_error("light of sun and sky", colors), 0.02);
    EXPECT_EQ(colors.ways[0].error.left_out, 0);
}

TEST(PlanLight, SurroundingsAreMapsForEachSun) {
    const Plan plan = plan_of(config::Draws::surroundings);
    EXPECT_LT(least_error("panoramas", plan), 0.05);
    EXPECT_LT(least_error("octahedra", plan), 0.05);
    const auto error = [&](const std::string& name) {
        return std::ranges::find(plan.ways, name,
                                 [](const MeasuredWay& way) { return full_name(way.way); })
            ->error.ninth_decile;
    };
    EXPECT_LT(error("panoramas, 256x128, half"), 0.7 * error("panoramas, 32x16, half"));
    test::expect_refused(
        plan_light(request_of("preset = \"earth_hillaire\"\n"), config::Draws::surroundings),
        "E0105");
}

// A recipe of several choices bakes each asset once.
TEST(PlanLight, OneRecipeBakesAllThatWasChosen) {
    const Plan ground = plan_of(config::Draws::ground_light);
    const std::vector<Plan> plans = {plan_of(config::Draws::surroundings), ground, ground};
    const auto recipe = test::without_errors(
        config::parse_recipe(planned_recipe(plans, *request_of(kScene).load({}).value), "planned"));
    std::size_t assets = 0;
    for (std::size_t i = 0; i < 2; ++i) assets += plans[i].ways[plans[i].chosen].way.assets.size();
    EXPECT_EQ(recipe.parameters.bakes.size(), assets);
}

TEST(PlanSky, SkyViewsNeedSuns) {
    test::expect_refused(
        plan_sky(request_of("preset = \"earth_hillaire\"\n[scene]\nsky_by = [\"picture\"]\n")),
        "E0105");
}

// Night has no error of 0: nothing can be told of it.
TEST(PlanSky, NightsAreTooDarkToPlanWith) {
    test::expect_refused(plan_sky(request_of("preset = \"earth_hillaire\"\n[scene]\n"
                                             "suns = [\"-15 deg\"]\nsky_by = [\"picture\"]\n")),
                         "E0409");
}

TEST(PlanSky, AnInterruptionLeavesNothing) {
    for (const char* step : {"baking assets", "tracing paths"}) {
        testing::CancelledAt progress(step, 1);
        PlanRequest request = request_of(kQuick);
        request.progress = &progress;
        const auto outcome = plan_sky(request);
        EXPECT_TRUE(progress.cancelled()) << step;
        EXPECT_FALSE(outcome.value) << step;
        EXPECT_TRUE(outcome.diagnostics.empty()) << step;
    }
}

}  // namespace
}  // namespace skybake
