#include "config/assets/asset_kind.h"

#include <gtest/gtest.h>

#include "config/assets/multiple_scattering.h"
#include "config/assets/transmittance.h"
#include "tests/config/recipes.h"

namespace skybake::config {
namespace {

Recipe bake(const std::string& text) { return valid("preset = 'vacuum'\n" + text); }

TEST(BakeDecoder, HasTheBestDefaults) {
    const Recipe recipe = bake("[bake.transmittance]\n[bake.multiple_scattering]\n");
    ASSERT_EQ(recipe.parameters.bakes.size(), 2u);
    const auto* transmittance = recipe.parameters.bakes[0].find<TransmittanceBake>();
    ASSERT_TRUE(transmittance);
    EXPECT_EQ(transmittance->size, (std::array<int, 2>{256, 64}));
    EXPECT_FALSE(transmittance->max_error);
    EXPECT_EQ(transmittance->content, TransmittanceContent::transmittance);
    EXPECT_EQ(transmittance->mapping, TransmittanceMapping::bruneton);
    EXPECT_EQ(transmittance->pixel_type, PixelType::float32);
    EXPECT_EQ(transmittance->compression, Compression::zip);
    const auto* scattering = recipe.parameters.bakes[1].find<MultipleScatteringBake>();
    ASSERT_TRUE(scattering);
    EXPECT_EQ(scattering->size, (std::array<int, 2>{64, 64}));
    EXPECT_EQ(scattering->mapping, MultipleScatteringMapping::twilight);
    EXPECT_EQ(scattering->method, MultipleScatteringMethod::solved);
    const Recipe closure = bake("[bake.multiple_scattering]\nmethod = 'converged'\n");
    EXPECT_EQ(closure.parameters.bakes[0].as<MultipleScatteringBake>().max_texel_error, 0.002);
}

TEST(BakeDecoder, EveryAssetOfTheTablesHasItsStruct) {
    for (const std::string_view asset : asset_names()) {
        std::string keys;
        if (asset == "noise_volume" || asset == "weather_map") keys = "noise = 'n'\n";
        if (asset == "cloud_volume") keys = "cloud = 'c'\nsize = [16, 16, 16]\n";
        if (asset == "occupancy" || asset == "cloud_distance") keys = "of = 'v'\n";
        if (asset == "flipbook") keys = "of = 'v'\n";
        const std::string volume =
            asset == "flipbook" ? "[bake.v_0001]\nframe = 1\n" : "[bake.v]\n";
        if (asset == "cloud_light") keys = "of = 'v'\nsun_elevations = '30 deg'\n";
        if (asset == "sky_view") keys = "sun_elevations = '30 deg'\n";
        if (asset == "phase") keys = "particles = 'p'\n";
        if (asset == "aerial_perspective" || asset == "environment") {
            keys = "sun_elevation = '30 deg'\n";
        }
        const Recipe recipe = bake(
            "[atmosphere.layers.air]\nprofile = 'exponential'\nscale_height = '8 km'\n"
            "[particles.p]\npreset = 'fog'\n[noise.n]\nperiod = 1\n[noise.n.channels.Y]\ntype = "
            "'perlin'\n[clouds.c]\nnoise = 'n'\n"
            "extent = ['1 m', '1 m', '1 m']\n" +
            volume + "asset = 'cloud_volume'\ncloud = 'c'\nsize = [16, 16, 16]\n[bake." +
            std::string(asset) + "]\n" + keys);
        ASSERT_EQ(recipe.parameters.bakes.size(), 2u) << asset;
        EXPECT_EQ(recipe.parameters.bakes[1].name, asset);
    }
}

TEST(BakeDecoder, AssetDefaultsToTheName) {
    const Recipe recipe = bake("[bake.mine]\nasset = 'transmittance'\nmapping = 'ue'\n");
    ASSERT_EQ(recipe.parameters.bakes.size(), 1u);
    EXPECT_EQ(recipe.parameters.bakes[0].name, "mine");
    EXPECT_EQ(recipe.parameters.bakes[0].as<TransmittanceBake>().mapping, TransmittanceMapping::ue);
}

TEST(BakeDecoder, BakesStandInTheOrderOfTheFile) {
    const Recipe recipe = bake(
        "[bake.z]\nasset = 'transmittance'\n[bake.multiple_scattering]\n"
        "[bake.a]\nasset = 'transmittance'\n");
    ASSERT_EQ(recipe.parameters.bakes.size(), 3u);
    EXPECT_EQ(recipe.parameters.bakes[0].name, "z");
    EXPECT_EQ(recipe.parameters.bakes[1].name, "multiple_scattering");
    EXPECT_EQ(recipe.parameters.bakes[2].name, "a");
}

TEST(BakeDecoder, AnErrorBoundStandsInPlaceOfASize) {
    const Recipe recipe = bake("[bake.transmittance]\nmax_error = '2 %'\n");
    const auto& asset = recipe.parameters.bakes.at(0).as<TransmittanceBake>();
    EXPECT_EQ(asset.max_error, 0.02);
    EXPECT_EQ(asset.size, (std::array<int, 2>{0, 0}));
    EXPECT_FALSE(has_value(recipe, "bake.transmittance.size"));
}

TEST(BakeDecoder, RefusesUnknownAssets) {
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
