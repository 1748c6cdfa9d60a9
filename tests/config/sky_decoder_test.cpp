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

using testing::codes_and_places;
using testing::parse;
using testing::valid;
using testing::value_at;

constexpr double degree = std::numbers::pi / 180;
using Codes = std::vector<std::string>;

Recipe earth(const std::string& text) { return valid("preset = 'earth_hillaire'\n" + text); }

Codes faults(const std::string& text) {
    return codes_and_places(parse("preset = 'earth_hillaire'\n" + text).diagnostics);
}

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

TEST(Scene, WantsItsBoundsInOrderAndInRange) {
    EXPECT_EQ(faults("[scene]\naltitude = ['3 km', '0 km']"), Codes{"E0113 3:12"});
    EXPECT_EQ(faults("[scene]\naltitude = ['-1 km', '0 km']"), Codes{"E0110 3:13"});
    EXPECT_EQ(faults("[scene]\naltitude = '3 km'"), Codes{"E0103 3:12"});
    EXPECT_EQ(faults("[scene]\nsun_elevation = ['-10 deg', '91 deg']"), Codes{"E0110 3:29"});
    EXPECT_EQ(faults("[scene]\nsun_elevation = ['-10 deg']"), Codes{"E0108 3:17"});
    EXPECT_EQ(faults("[scene]\nsun_elevation = ['-10 km', '90 deg']"), Codes{"E0107 3:18"});
    EXPECT_EQ(faults("scene = 1"), Codes{"E0103 2:9"});
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
    EXPECT_EQ(faults("[bake.sky_view]\nsun_elevations = []"), Codes{"E0108 3:18"});
    EXPECT_EQ(faults("[bake.sky_view]\n"), Codes{"E0105 2:7"});
}

TEST(SkyView, LayersBelongToSingleScatteringAndAreThoseOfTheAtmosphere) {
    const std::string view = "[bake.sky_view]\nsun_elevations = '30 deg'\n";
    const auto mie =
        only_bake<SkyViewBake>(earth(view + "orders = 'single'\nlayers = ['mie', 'ozone']\n"));
    EXPECT_EQ(mie.layers, (Codes{"mie", "ozone"}));
    EXPECT_EQ(faults(view + "layers = ['mie']"), Codes{"E0111 4:1"});
    EXPECT_EQ(faults(view + "orders = 'single'\nlayers = ['mei']"), Codes{"E0138 5:10"});
    EXPECT_EQ(faults(view + "orders = 'single'\nlayers = ['mie', 'mie']"), Codes{"E0138 5:10"});
    EXPECT_EQ(faults("[atmosphere.layers.mie]\nenabled = false\n" + view +
                     "orders = 'single'\nlayers = ['mie']"),
              Codes{"E0138 7:10"});
    // Faults elsewhere are not reported twice.
    EXPECT_EQ(
        faults("[atmosphere.layers.mie]\ng = 2\n" + view + "orders = 'single'\nlayers = ['mie']"),
        Codes{"E0110 3:5"});
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
    EXPECT_EQ(faults("[bake.aerial_perspective]\nsun_elevation = '30 deg'\naltitude = '-430 m'"),
              Codes{"E0110 4:12"});
}

TEST(AerialPerspective, NeedsChannelsThatMakeAPicture) {
    const std::string grey = "preset = 'vacuum'\nwavelengths = '550 nm'\n";
    const std::string volume = "[bake.aerial_perspective]\nsun_elevation = '30 deg'\n";
    EXPECT_EQ(codes_and_places(parse(grey + volume).diagnostics), Codes{"E0129 3:7"});
    EXPECT_TRUE(parse(grey + volume + "content = 'in_scatter'").value);
    EXPECT_EQ(faults(volume + "fov = '180 deg'"), Codes{"E0110 4:7"});
    EXPECT_EQ(faults(volume + "pixel_type = 'unorm8'"), Codes{"E0131 4:14"});
}

TEST(Irradiance, OrdersBelongToTheSkyAndLayersToSingleScattering) {
    const std::string table = "[bake.irradiance]\n";
    EXPECT_EQ(only_bake<IrradianceBake>(earth(table)).content, IrradianceContent::total);
    const auto single = only_bake<IrradianceBake>(
        earth(table + "content = 'sky'\norders = 'single'\nlayers = 'mie'"));
    EXPECT_EQ(single.layers, Codes{"mie"});
    EXPECT_EQ(faults(table + "orders = 'single'"), Codes{"E0111 3:1"});
    EXPECT_EQ(faults(table + "layers = 'mie'"), Codes{"E0111 3:1"});
}

TEST(MultipleScattering, ContentBelongsToSolvedTablesAndDegreeToMoments) {
    const std::string table = "[bake.multiple_scattering]\n";
    const auto moments =
        only_bake<MultipleScatteringBake>(earth(table + "content = 'moments'\ndegree = 4"));
    EXPECT_EQ(moments.content, MultipleScatteringContent::moments);
    EXPECT_EQ(moments.degree, 4);
    EXPECT_EQ(only_bake<MultipleScatteringBake>(earth(table)).content,
              MultipleScatteringContent::hillaire);
    EXPECT_EQ(faults(table + "method = 'converged'\ncontent = 'moments'"), Codes{"E0111 4:1"});
    EXPECT_EQ(faults(table + "max_texel_error = '1 %'"), Codes{"E0111 3:1"});
    EXPECT_EQ(faults(table + "degree = 3"), Codes{"E0111 3:1"});
    EXPECT_EQ(faults(table + "content = 'moments'\ndegree = 9"), Codes{"E0110 4:10"});
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
