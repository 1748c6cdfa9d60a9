#include "bakers/preview/live/live_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "bakers/math/half_conversion.h"
#include "bakers/preview/live/live_textures.h"
#include "bakers/preview/runtime/runtime_library.h"
#include "bakers/render/cloud_view.h"
#include "bakers/render/scene_march.h"
#include "bakers/render/tone_curve.h"
#include "tests/preview/skies.h"
#include "tests/support/refused.h"

namespace skybake {
namespace {

using nlohmann::json;
using test::baked;

const std::string kSky =
    "preset = \"earth_hillaire\"\n[bake.transmittance]\nsize = [64, 16]\n"
    "[bake.multiple_scattering]\nmethod = \"converged\"\nmapping = \"hillaire\"\nsize = [16, 16]\n";
const std::string kCloud =
    "[noise.n]\nsize = [32, 32, 32]\n[noise.n.channels.Y]\ntype = \"worley\"\nfrequency = 3\n"
    "octaves = 1\n[clouds.c]\nnoise = \"n\"\nextent = [\"3 km\", \"2 km\", \"0.7 km\"]\n"
    "base_altitude = \"1 km\"\ncoverage = 0.6\nextinction_scale = \"40 /km\"\n"
    "[bake.volume]\nasset = \"cloud_volume\"\ncloud = \"c\"\nsize = [16, 12, 8]\n";

json scene_of(const std::string& text, const PreviewOptions& options = {}) {
    const auto scene = live_scene(baked(text), options);
    EXPECT_TRUE(scene.value);
    return scene.value ? json::parse(*scene.value) : json();
}

std::vector<std::string> texture_names(const json& scene) {
    std::vector<std::string> names;
    for (const json& texture : scene["textures"]) names.push_back(texture["name"]);
    return names;
}

TEST(LiveScene, HoldsTheTablesOfASky) {
    const json scene = scene_of(kSky);
    EXPECT_EQ(texture_names(scene),
              (std::vector<std::string>{"transmittance_table", "multiple_scattering_table"}));
    EXPECT_EQ(scene["textures"][0]["size"], json({64, 16}));
    EXPECT_EQ(scene["textures"][0]["type"], "float");
    EXPECT_TRUE(scene["clouds"].empty());
    EXPECT_EQ(scene["light"], "the recipe's atmosphere");
}

// The phase functions of spheres have no closed form: the page reads them from a table.
TEST(LiveScene, HoldsTheTableOfPhaseFunctionsOfSpheres) {
    std::string recipe = kSky;
    recipe.replace(recipe.find("earth_hillaire"), 14, "mars");
    const json scene = scene_of(recipe);
    EXPECT_EQ(texture_names(scene),
              (std::vector<std::string>{"transmittance_table", "multiple_scattering_table",
                                        "phase_rows"}));
    EXPECT_NE(scene["air"].get<std::string>().find("phase_in_row(phase_rows, "), std::string::npos);
}

TEST(LiveScene, HoldsACloudAndBakesTheLightThatIsMissing) {
    const json scene = scene_of(kCloud);
    EXPECT_EQ(texture_names(scene),
              (std::vector<std::string>{"transmittance_table", "multiple_scattering_table",
                                        "cloud_table_0", "cells_table_0", "shift_table"}));
    EXPECT_EQ(scene["clouds"][0]["name"], "volume");
    EXPECT_EQ(scene["clouds"][0]["tile"], json({3000.0, 2000.0, 700.0}));
    EXPECT_EQ(scene["clouds"][0]["base"], 1000.0);
    EXPECT_DOUBLE_EQ(scene["clouds"][0]["extinction"], 0.04);
    EXPECT_EQ(scene["textures"][2]["size"], json({16, 12, 8}));
    EXPECT_EQ(scene["textures"].back()["size"], json({kVariedTiles, kVariedTiles}));
    EXPECT_EQ(scene["light"], "the preset earth, whose tables were baked for this page");
    const json on_mars = scene_of("preset = \"mars_rgb\"\n" + kCloud);
    EXPECT_EQ(on_mars["light"], "the recipe's atmosphere, whose tables were baked for this page");
    EXPECT_NE(on_mars["textures"][0], scene["textures"][0]);
}

// The matrix of the lookup makes equal channels of the daylight on level ground, of the same luminance.
TEST(LiveScene, PrintsTheWhiteOfItsDaylight) {
    const PreviewAssets assets = baked(kSky);
    const std::string film = runtime_library(assets, 1);
    const RuntimeAir air = *runtime_air(*assets.recipe, assets, 1);
    const GroundIrradiance ground =
        ground_irradiance({air.medium, air.tables}, {kDaylightElevation, 0}, 1);
    glm::dvec3 white(0);
    for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t at = film.find(std::string("light.") + "xyz"[c] + " * vec3(");
        ASSERT_NE(at, std::string::npos);
        glm::dvec3 column;
        ASSERT_EQ(std::sscanf(film.c_str() + at, "light.%*c * vec3(%lf, %lf, %lf)", &column.x,
                              &column.y, &column.z),
                  3);
        white += (ground.sun[c] + ground.sky[c]) * column;
    }
    EXPECT_NEAR(white.x / white.y, 1, 1e-4);
    EXPECT_NEAR(white.z / white.y, 1, 1e-4);
    // Three wavelengths are shown as they are without that white, and luminance stays.
    const auto luminance = [](const auto& at) {
        return 0.2126 * at(0) + 0.7152 * at(1) + 0.0722 * at(2);
    };
    EXPECT_NEAR(luminance([&](std::size_t c) { return ground.sun[c] + ground.sky[c]; }) / white.y,
                1, 1e-3);
    EXPECT_EQ(runtime_library(baked(kCloud), 1), "");
}

// A page that begins with a single tile can show the layer too, with the same copies.
TEST(LiveScene, HoldsTheCopiesOfASingleTile) {
    PreviewOptions single;
    single.single = true;
    const json layer = scene_of(kCloud);
    const json tile = scene_of(kCloud, single);
    EXPECT_EQ(tile["clouds"][0]["repeats"], false);
    EXPECT_EQ(tile["textures"].back(), layer["textures"].back());
    EXPECT_EQ(texture_names(tile), texture_names(layer));
}

// Several clouds are those of one sky, and they fade before the horizon.
TEST(LiveScene, HoldsSeveralCloudsWithTheirCopies) {
    std::string second = kCloud.substr(kCloud.find("[clouds.c]"));
    for (const auto& [from, to] : {std::pair{"clouds.c", "clouds.d"}, std::pair{"\"c\"", "\"d\""},
                                   std::pair{"bake.volume", "bake.high"},
                                   std::pair{"16, 12, 8", "8, 8, 4"}, std::pair{"1 km", "4 km"}}) {
        second.replace(second.find(from), std::string(from).size(), to);
    }
    const json scene = scene_of(kCloud + second);
    ASSERT_EQ(scene["clouds"].size(), 2U);
    EXPECT_EQ(scene["clouds"][1]["name"], "high");
    EXPECT_EQ(scene["clouds"][1]["base"], 4000.0);
    EXPECT_EQ(texture_names(scene).back(), "shift_table");
    EXPECT_EQ(scene["textures"].back()["size"], json({kVariedTiles, 2 * kVariedTiles}));
    EXPECT_EQ(scene["clouds"][0]["fade_from"], kFadeFrom);
    PreviewOptions single;
    single.single = true;
    EXPECT_EQ(scene_of(kCloud + second, single)["clouds"].size(), 1U);
}

// The page's rule is that of the pictures: a grey picture gets the same exposure.
TEST(LiveScene, HasThePicturesRuleOfExposure) {
    for (const auto& [text, rule] :
         {std::pair{kSky, kSkyPicture}, std::pair{kSky + kCloud, kCloudPicture}}) {
        const json exposure = scene_of(text)["exposure"];
        EXPECT_EQ(exposure["quantile"], rule.quantile);
        EXPECT_EQ(exposure["lit_pixels"], rule.lit_pixels);
        EXPECT_EQ(exposure["bright_quantile"], rule.bright_quantile);
        EXPECT_EQ(exposure["bright_light"].is_null(), rule.bright_quantile == 0);
        EXPECT_EQ(exposure["least_median"].is_null(), rule.least_median == 0);
        EXPECT_NEAR(exposure["light"]["exponential"], -rule.factor * std::log(1 - rule.share),
                    1e-9);
        Image2<float> grey(1, 1, 1);
        grey.texels[0] = 0.5F;
        for (const auto& [name, curve] :
             {std::pair{"film", ToneCurve::film}, std::pair{"aces", ToneCurve::aces},
              std::pair{"agx", ToneCurve::agx}}) {
            EXPECT_NEAR(exposure["light"][name], 0.5 * exposure_by(rule, grey, curve), 1e-6);
        }
    }
}

// By the page's table, pictures under a sun of -6, 12 and 30 degrees are as dark as the preview's are.
TEST(LiveScene, DimsEveningsAsPicturesDo) {
    const PreviewAssets assets = baked(kSky);
    const json dimmed = scene_of(kSky)["exposure"]["dimming"];
    EXPECT_EQ(dimmed, scene_of(kSky + kCloud)["exposure"]["dimming"]);
    const double first = dimmed["first_deg"], step = dimmed["step_deg"];
    const RuntimeAir air = *runtime_air(*assets.recipe, assets, 1);
    for (const double sun : {-6, 12, 30}) {
        const double share = daylight_shares({air.medium, air.tables}, {{sun, 0}}, 1).front();
        const auto at = static_cast<std::size_t>((sun - first) / step);
        EXPECT_NEAR(dimmed["factors"][at], dimming(share), 1e-6) << sun;
    }
}

TEST(LiveScene, TakesTheViewFromTheOptions) {
    PreviewOptions options;
    options.sun_elevations_deg = {7};
    options.sun_azimuth_deg = 30;
    options.exposure_stops = 2;
    options.tone_curve = ToneCurve::agx;
    options.camera = CameraRequest{{{100, 200, 300}}, 10, 20, 40};
    for (const std::string& text : {kSky, kSky + kCloud}) {
        const json view = scene_of(text, options)["view"];
        EXPECT_EQ(view["position"], json({100.0, 200.0, 300.0}));
        EXPECT_EQ(view["heading"], 10);
        EXPECT_EQ(view["pitch"], 20);
        EXPECT_EQ(view["fov"], 40);
        EXPECT_EQ(view["sun_elevation"], 7);
        EXPECT_EQ(view["sun_azimuth"], 30);
        EXPECT_EQ(view["exposure"], 2);
        EXPECT_EQ(view["tone_curve"], "agx");
    }
}

// Nobody has placed the sun: it stands beside the view, wherever that looks. The glare is off.
TEST(LiveScene, HasTheSunBesideTheViewWithoutGlare) {
    for (const double heading : {10.0, 300.0}) {
        PreviewOptions options;
        options.camera = CameraRequest{std::nullopt, heading, {}, {}};
        for (const std::string& text : {kSky, kSky + kCloud}) {
            const json view = scene_of(text, options)["view"];
            const double turn = view["sun_azimuth"].get<double>() - heading - kSunBesideView;
            EXPECT_NEAR(std::remainder(turn, 360), 0, 1e-9) << heading;
            EXPECT_EQ(view["glare"], false);
            EXPECT_EQ(view["tone_curve"], "film");
        }
    }
}

// The slider begins at -180 degrees. The sun of an evening, found by --at, is at 90 degrees less its
// azimuth from north, and stands there under another number.
TEST(LiveScene, TurnsTheSunIntoTheRangeOfItsSlider) {
    for (const auto& [given, shown] :
         {std::pair{-206.3, 153.7}, {-360.0, 0.0}, {270.0, -90.0}, {105.0, 105.0}}) {
        PreviewOptions options;
        options.sun_azimuth_deg = given;
        EXPECT_NEAR(scene_of(kSky, options)["view"]["sun_azimuth"].get<double>(), shown, 1e-9);
    }
}

TEST(LiveScene, IsRefusedWithoutARecipe) {
    PreviewAssets assets = baked(kSky);
    assets.recipe.reset();
    test::expect_refused(live_scene(assets, {}), "E0001");
}

PreviewAsset volume_of(const std::vector<float>& voxels, int channels) {
    PreviewAsset asset;
    for (int c = 0; c < channels; ++c)
        asset.entry.channels.push_back(std::string(1, char('R' + c)));
    asset.voxels = voxels;
    return asset;
}

TEST(LiveTextures, HoldBytesWhereTheVolumeHasThem) {
    const PackedVolume bytes = packed_volume(volume_of({0, 1.0F / 255, 128.0F / 255, 1}, 1));
    EXPECT_STREQ(bytes.type, "unorm8");
    EXPECT_EQ(bytes.texels, std::string("\x00\x01\x80\xff", 4));
    EXPECT_LT(bytes.greatest_error, 0x1p-24);  // the error of the float 128 / 255
}

TEST(LiveTextures, HoldTheFirstChannelAsHalves) {
    const PackedVolume halves = packed_volume(volume_of({0.1F, 9, -2, 9, 70, 9}, 2));
    EXPECT_STREQ(halves.type, "half");
    ASSERT_EQ(halves.texels.size(), 6U);
    EXPECT_GT(halves.greatest_error, 0);
    EXPECT_LT(halves.greatest_error, 0.1 * 0x1p-11);
    const auto at = [&](std::size_t i) {
        const auto byte = [&](std::size_t b) {
            return static_cast<unsigned char>(halves.texels[b]);
        };
        return float_of_half(static_cast<std::uint16_t>(byte(2 * i) | byte(2 * i + 1) << 8));
    };
    EXPECT_EQ(at(1), -2);
    EXPECT_EQ(at(2), 70);
}

TEST(LiveTextures, CountLeapsInCells) {
    LeapGrid grid;
    grid.cell = 4;
    grid.reach = {-1, 0, 4, 11, 1e9F};
    EXPECT_EQ(leap_bytes(grid), std::string("\x00\x01\x02\x03\xff", 5));
}

}  // namespace
}  // namespace skybake
