#include "bakers/plan/plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <string>

#include "bakers/plan/cloud_ways.h"
#include "bakers/plan/plan_files.h"
#include "config/recipe/recipe.h"
#include "tests/support/refused.h"

namespace skybake {
namespace {

const std::string kScene =
    "[scene]\naltitude = [\"0 m\", \"400 m\"]\nview_distance = \"10 km\"\n"
    "[clouds.c]\npreset = \"cumulus_humilis\"\nextent = [\"1.5 km\", \"1.5 km\", \"0.75 km\"]\n"
    "detail_scale = [4, 4, 2]\n[clouds.c.convection]\ncells = [32, 32, 16]\npatches = 4\n"
    "[bake.c]\nasset = \"cloud_volume\"\ncloud = \"c\"\nsize = [64, 64, 32]\n";

PlanRequest request_of_scene(const std::string& setting = "") {
    PlanRequest request;
    request.load = [setting](std::span<const std::string> settings) {
        std::vector<std::string> all(settings.begin(), settings.end());
        if (!setting.empty()) all.push_back(setting);
        return config::parse_recipe(kScene, "scene", {}, all);
    };
    request.paths = 1 << 18;
    return request;
}

PlanRequest request_with_sun() { return request_of_scene("scene.suns=[\"35 deg\"]"); }

// 100 voxels, as a quarter of 400 is, have no cells of 8.
TEST(CloudWays, HaveCellsThatTileTheirVoxels) {
    int of_cells = 0;
    for (const CloudWay& way : cloud_ways({"c", {400, 400, 64}, "", {}})) {
        if (way.cell == 0) continue;
        ++of_cells;
        const std::string& size = way.assets[0].keys[2].second;
        EXPECT_TRUE(size != "[100, 100, 16]" || way.cell < 8) << way.name;
    }
    EXPECT_GT(of_cells, 20);
}

// The plan of one scene, made once.
const Plan& plan() {
    static const Plan plan = *plan_cloud(request_with_sun(), "c").value;
    return plan;
}

double least_error(const std::string& family) {
    double least = 1e9;
    for (const MeasuredWay& way : plan().ways) {
        if (way.way.family == family) least = std::min(least, way.figures.error);
    }
    return least;
}

void expect_solved_light_is_nearest() {
    EXPECT_LT(least_error("radiance for each sun"), 0.1);
    EXPECT_LT(least_error("radiance for each sun"), least_error("octaves, depths for each sun"));
    EXPECT_LT(least_error("octaves, a march to the sun"), least_error("single scattering") / 1.5);
    EXPECT_GT(least_error("single scattering"), 0.2);
}

void expect_costs_of_textures() {
    bool found = false;
    for (const MeasuredWay& way : plan().ways) {
        if (way.way.family != "octaves, depths for each sun") continue;
        if (way.way.name.rfind("64x64x32, bc4, texels of 4 voxels", 0) != 0) continue;
        found = true;
        double bytes = 64 * 64 * 32 / 2 + 16 * 16 * 8 * 2;
        for (const WayAsset& asset : way.way.assets) {
            if (asset.name == "c_cells") bytes += 32 * 32 * 16;  // cells of two voxels at most
        }
        EXPECT_LE(way.figures.bytes, bytes);
        EXPECT_GT(way.figures.bytes, 64 * 64 * 32 / 2);
        EXPECT_GT(way.figures.fetches, 1);
    }
    EXPECT_TRUE(found);
}

// A lit sample looks up a depth, or marches: 4 lookups cost 3 more, and 16 cost 12 more than these.
void expect_lookups_of_light() {
    const auto fetches = [](const std::string& family, const std::string& what) {
        for (const auto& [way, error, figures, bake_s, on_front] : plan().ways) {
            if (way.family != family || !way.name.starts_with("64x64x32, half, " + what)) continue;
            return figures.fetches;
        }
        return 0.0;
    };
    const double few = fetches("octaves, a march to the sun", "4 samples");
    const double more = few - fetches("octaves, depths for each sun", "texels of 4 voxels");
    EXPECT_GT(more, 3);
    EXPECT_NEAR(fetches("octaves, a march to the sun", "16 samples") - few, 4 * more, 1e-6);
}

// Ways that show the same picture appear once, with the cells that cost least.
void expect_each_drawing_once() {
    for (const MeasuredWay& way : plan().ways) {
        const auto others =
            std::count_if(plan().ways.begin(), plan().ways.end(), [&](const MeasuredWay& other) {
                const auto drawn = [](const std::string& name) {
                    return name.substr(0, name.find(", leaps over"));
                };
                return other.way.family == way.way.family &&
                       drawn(other.way.name) == drawn(way.way.name);
            });
        EXPECT_EQ(others, 1) << full_name(way.way);
    }
}

void expect_recipe_of_choice() {
    const auto scene = request_with_sun().load({});
    const std::string text = planned_recipe({&plan(), 1}, *scene.value);
    const auto recipe = config::parse_recipe(text, "planned");
    ASSERT_TRUE(recipe.value) << text << recipe.diagnostics.front().message;
    const Way& chosen = plan().ways[plan().chosen].way;
    ASSERT_EQ(recipe.value->parameters.bakes.size(), chosen.assets.size()) << text;
}

// Other views and other paths find the error that the plan claims.
void expect_claimed_error_in_other_views() {
    const MeasuredWay& chosen = plan().ways[plan().chosen];
    PlanRequest request = request_with_sun();
    request.judged = &chosen.way;
    const auto judged = plan_cloud(request, "c");
    ASSERT_TRUE(judged.value && judged.value->ways.size() == 1);
    const double error = judged.value->ways[0].figures.error;
    std::printf("%s: claimed %.3g, judged %.3g\n", full_name(chosen.way).c_str(),
                chosen.figures.error, error);
    EXPECT_NE(error, chosen.figures.error);
    EXPECT_LT(error, 1.3 * chosen.figures.error);
    EXPECT_GT(error, chosen.figures.error / 1.3);
}

// One test, since a plan takes seconds.
TEST(PlanCloud, MeasuresWaysAndChooses) {
    expect_solved_light_is_nearest();
    expect_costs_of_textures();
    expect_lookups_of_light();
    expect_each_drawing_once();
    expect_recipe_of_choice();
    expect_claimed_error_in_other_views();
}

// Without suns of its own a scene has those of a day, and no light of one sun alone.
TEST(PlanCloud, AnySunLeavesOutTheLightOfOne) {
    PlanRequest request = request_of_scene();
    request.paths = 1 << 12;
    const auto any = plan_cloud(request, "c");
    ASSERT_TRUE(any.value);
    for (const MeasuredWay& way : any.value->ways) {
        EXPECT_NE(way.way.by, "depth");
        EXPECT_NE(way.way.by, "radiance");
    }
    ASSERT_EQ(any.value->notes.size(), 1u);
}

TEST(PlanCloud, NightsAndCloudsThatNobodySeesHaveNoPlan) {
    for (const char* setting :
         {"scene.suns=[\"-5 deg\"]", "clouds.c.extinction_scale=\"1e-9 /km\""}) {
        PlanRequest request = request_of_scene(setting);
        request.paths = 1 << 12;
        SCOPED_TRACE(setting);
        test::expect_refused(plan_cloud(request, "c"), "E0409");
    }
}

}  // namespace
}  // namespace skybake
