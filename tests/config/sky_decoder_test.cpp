// [scene], and assets that are pictures: cases/ has what their keys are by default.

#include <gtest/gtest.h>

#include <numbers>

#include "config/assets/asset_kind.h"
#include "config/assets/blue_noise.h"
#include "config/assets/bruneton.h"
#include "config/assets/environment.h"
#include "config/assets/sky_view.h"
#include "config/assets/weather_map.h"
#include "tests/config/recipes.h"

namespace skybake::config {
namespace {

constexpr double degree = std::numbers::pi / 180;
using Codes = std::vector<std::string>;
using Size = std::array<int, 2>;

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
    const auto three = only_bake<SkyViewBake>(
        earth("[bake.sky_view]\nsun_elevations = ['90 deg', '0 deg', '-90 deg']\n"));
    ASSERT_EQ(three.sun_elevations.size(), 3u);
    EXPECT_EQ(three.sun_elevations[2].radians, -std::numbers::pi / 2);
    EXPECT_EQ(three.size, (Size{192, 108}));
    EXPECT_EQ(three.orders, SkyOrders::all);
    EXPECT_TRUE(three.layers.empty());
}

TEST(Bruneton, HasDefaultsOfItsOwn) {
    const auto scattering = only_bake<BrunetonBake>(earth("[bake.bruneton]\n"));
    EXPECT_EQ(scattering.orders, 0);
    EXPECT_EQ(scattering.mie_layers, Codes{"mie"});
    EXPECT_EQ(scattering.solar_irradiance, (std::vector<double>{1, 1, 1}));
    EXPECT_NEAR(scattering.sun_cos_zenith_min, -0.2079, 1e-4);
}

TEST(Environment, CloudsAreAVolumeOfTheRecipe) {
    const Recipe recipe = earth(
        "[bake.environment]\nsun_elevation = '20 deg'\nclouds = 'v'\ncamera_x = '2 km'\n"
        "samples = 3\n[noise.n.channels.Y]\ntype = 'perlin'\n[clouds.c]\nnoise = 'n'\n"
        "extent = ['1 km', '1 km', '1 km']\n"
        "[bake.v]\nasset = 'cloud_volume'\ncloud = 'c'\nsize = [16, 16, 16]\n");
    const auto& bake = recipe.parameters.bakes.front().as<EnvironmentBake>();
    EXPECT_TRUE(bake.has_clouds());
    EXPECT_EQ(bake.camera_x.meters, 2000);
    EXPECT_EQ(bake.samples, 3);
}

using Shares = std::vector<double>;

TEST(WeatherMap, ReadsEveryKey) {
    const auto bake = only_bake<WeatherMapBake>(valid(
        "[noise.n.channels.R]\ntype = 'perlin'\n[noise.n.channels.G]\ntype = 'perlin'\n"
        "[noise.n.channels.B]\ntype = 'perlin'\n[bake.a]\nasset = 'weather_map'\nnoise = 'n'\n"
        "size = [16, 24]\ncovered = ['30 %', 0.5, 1]\nfull = 0.1\nedge = 'smooth'\n"
        "yields_to = ['G', '', '']\nstreaks = [0, 0, 0.05]\nwind = '-90 deg'\n"));
    EXPECT_EQ(bake.size, (Size{16, 24}));
    EXPECT_EQ(bake.covered, (Shares{0.3, 0.5, 1}));
    EXPECT_EQ(bake.full, (Shares{0.1, 0.1, 0.1}));
    EXPECT_EQ(bake.edge, CoverEdge::smooth);
    EXPECT_EQ(bake.yields_to, (Codes{"G", "", ""}));
    EXPECT_EQ(bake.streaks, (Shares{0, 0, 0.05}));
    EXPECT_NEAR(bake.wind.radians, -1.5707963, 1e-6);
}

TEST(BlueNoise, ReadsItsKeys) {
    const auto bake = only_bake<BlueNoiseBake>(
        valid("[bake.blue_noise]\nsize = [32, 24]\nframes = 2\nseed = 7\n"));
    EXPECT_EQ(bake.voxels(), (std::array<int, 3>{32, 24, 2}));
    EXPECT_EQ(bake.seed, 7U);
    EXPECT_EQ(bake.spatial_sigma, 1.9);
    EXPECT_EQ(bake.temporal_sigma, 1.9);
}

TEST(Bakes, StandInTheOrderOfTheFile) {
    const Recipe recipe = earth(
        "[bake.z]\nasset = 'transmittance'\n[bake.multiple_scattering]\n"
        "[bake.a]\nasset = 'transmittance'\n");
    ASSERT_EQ(recipe.parameters.bakes.size(), 3u);
    EXPECT_EQ(recipe.parameters.bakes[0].name, "z");
    EXPECT_EQ(recipe.parameters.bakes[1].name, "multiple_scattering");
    EXPECT_EQ(recipe.parameters.bakes[2].name, "a");
}

TEST(Bakes, RefusesUnknownAssets) {
    const auto diagnostics = parse(
                                 "preset = 'vacuum'\n[bake.transmitance]\n[bake.x]\nasset = 'sky'\n"
                                 "[bake.y]\nasset = 3\n")
                                 .diagnostics;
    ASSERT_EQ(diagnostics.size(), 3u);
    EXPECT_EQ(diagnostics[0].code, "E0118");
    EXPECT_EQ(diagnostics[0].label, "did you mean `transmittance`?");
    EXPECT_EQ(diagnostics[0].where.column, 7);
    EXPECT_EQ(diagnostics[1].code, "E0118");
    EXPECT_TRUE(diagnostics[1].label.starts_with("`asset` is one of transmittance, "));
    for (const std::string_view asset : asset_names()) {
        EXPECT_NE(diagnostics[1].label.find(asset), std::string::npos) << asset;
    }
    EXPECT_EQ(diagnostics[1].where.line, 4);
    EXPECT_EQ(diagnostics[2].code, "E0103");
}

}  // namespace
}  // namespace skybake::config
