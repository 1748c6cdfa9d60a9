// [scene], the assets of the sky, and what belongs to a solved table of multiple scattering.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "config/assets/aerial_perspective.h"
#include "config/assets/irradiance.h"
#include "config/assets/multiple_scattering.h"
#include "config/assets/sky_view.h"
#include "tests/config/recipes.h"

namespace skybake::config {
namespace {

constexpr double degree = std::numbers::pi / 180;
using Codes = std::vector<std::string>;

Recipe earth(const std::string& text) { return valid("preset = 'earth_hillaire'\n" + text); }

template <class Asset>
Asset only_bake(const Recipe& recipe) {
    EXPECT_EQ(recipe.parameters.bakes.size(), 1u);
    return recipe.parameters.bakes.at(0).as<Asset>();
}

TEST(Scene, IsThereOnlyWhereTheRecipeSaysSo) {
    EXPECT_FALSE(earth("").parameters.scene);
    const Recipe recipe = earth("[scene]\nsun_elevation = ['-10 deg', '90 deg']\n");
    ASSERT_TRUE(recipe.parameters.scene);
    const Scene& scene = *recipe.parameters.scene;
    EXPECT_EQ(scene.altitude[0].meters, 0);
    EXPECT_EQ(scene.altitude[1].meters, 3000);
    EXPECT_DOUBLE_EQ(scene.sun_elevation[0].radians, -10 * degree);
    EXPECT_DOUBLE_EQ(scene.sun_elevation[1].radians, 90 * degree);
    EXPECT_EQ(scene.view_distance.meters, 64000);
}

TEST(SkyView, TakesOneSunOrSeveral) {
    const auto one = only_bake<SkyViewBake>(earth("[bake.sky_view]\nsun_elevations = '30 deg'\n"));
    ASSERT_EQ(one.sun_elevations.size(), 1u);
    EXPECT_EQ(one.size, (std::array<int, 2>{192, 108}));
    EXPECT_EQ(one.orders, SkyOrders::all);
    EXPECT_TRUE(one.layers.empty());
    const auto three = only_bake<SkyViewBake>(
        earth("[bake.sky_view]\nsun_elevations = ['90 deg', '0 deg', '-90 deg']\n"));
    ASSERT_EQ(three.sun_elevations.size(), 3u);
    EXPECT_EQ(three.sun_elevations[2].radians, -std::numbers::pi / 2);
}

TEST(SkyView, LayersBelongToSingleScatteringAndAreThoseOfTheAtmosphere) {
    const std::string view = "[bake.sky_view]\nsun_elevations = '30 deg'\n";
    const auto mie =
        only_bake<SkyViewBake>(earth(view + "orders = 'single'\nlayers = ['mie', 'ozone']\n"));
    EXPECT_EQ(mie.layers, (Codes{"mie", "ozone"}));
}

TEST(AerialPerspective, TakesItsDistanceFromTheSceneUnlessItSaysOne) {
    const std::string volume = "[bake.aerial_perspective]\nsun_elevation = '30 deg'\n";
    const auto distance = [](const Recipe& recipe) {
        return only_bake<AerialPerspectiveBake>(recipe).view_distance.meters;
    };
    EXPECT_EQ(distance(earth(volume)), 64000);
    EXPECT_EQ(distance(earth("[scene]\nview_distance = '10 km'\n" + volume)), 10000);
    const Recipe own =
        earth("[scene]\nview_distance = '10 km'\n" + volume + "view_distance = '20 km'\n");
    EXPECT_EQ(distance(own), 20000);
    EXPECT_EQ(value_at(earth(volume), "bake.aerial_perspective.view_distance").origin, "derived");
}

// From space the way to the air is empty, and the longest way through it is 2 sqrt(top^2 - ground^2).
TEST(AerialPerspective, SlicesBeginWithTheAirInSpace) {
    const auto bake = [](const std::string& keys) {
        const std::string radii = "ground_radius = '6360 km'\ntop_radius = '6460 km'\n";
        return only_bake<AerialPerspectiveBake>(
            earth("[atmosphere]\n" + radii +
                  "[bake.aerial_perspective]\nsun_elevation = '30 deg'\n" + keys));
    };
    const auto space = bake("altitude = '400 km'\n");
    EXPECT_EQ(space.slices_begin, SlicesBegin::air);
    EXPECT_NEAR(space.view_distance.meters, 2 * std::sqrt(6460e3 * 6460e3 - 6360e3 * 6360e3), 1);
    EXPECT_EQ(bake("altitude = '400 km'\nview_distance = '30 km'\n").view_distance.meters, 30000);
    const auto own = bake("altitude = '400 km'\nslices_begin = 'camera'\n");
    EXPECT_EQ(own.slices_begin, SlicesBegin::camera);
    EXPECT_EQ(own.view_distance.meters, 64000);
    EXPECT_EQ(bake("altitude = '100 km'\n").slices_begin, SlicesBegin::camera);
}

TEST(Irradiance, OrdersBelongToTheSkyAndLayersToSingleScattering) {
    const std::string table = "[bake.irradiance]\n";
    EXPECT_EQ(only_bake<IrradianceBake>(earth(table)).content, IrradianceContent::total);
    const auto single = only_bake<IrradianceBake>(
        earth(table + "content = 'sky'\norders = 'single'\nlayers = 'mie'"));
    EXPECT_EQ(single.layers, Codes{"mie"});
}

TEST(MultipleScattering, ContentBelongsToSolvedTablesAndDegreeToMoments) {
    const std::string table = "[bake.multiple_scattering]\n";
    const auto moments =
        only_bake<MultipleScatteringBake>(earth(table + "content = 'moments'\ndegree = 4"));
    EXPECT_EQ(moments.content, MultipleScatteringContent::moments);
    EXPECT_EQ(moments.degree, 4);
    EXPECT_EQ(only_bake<MultipleScatteringBake>(earth(table)).content,
              MultipleScatteringContent::hillaire);
}

TEST(SkyAssets, CarryParametersThatAreARecipe) {
    const Recipe recipe = earth(
        "[scene]\nview_distance = '10 km'\n"
        "[bake.sky_view]\nsun_elevations = ['90 deg', '-90 deg']\norders = 'single'\n"
        "layers = ['mie']\n[bake.aerial_perspective]\nsun_elevation = '5 deg'\n[bake.irradiance]");
    const std::string patterns[] = {"*", "*.*", "*.*.*", "*.*.*.*"};
    const std::string text = parameters_toml(recipe, patterns);
    EXPECT_EQ(parameters_toml(valid(text), patterns), text);
}

}  // namespace
}  // namespace skybake::config
