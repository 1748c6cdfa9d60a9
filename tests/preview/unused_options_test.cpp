#include "bakers/preview/check_options.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <utility>

#include "tests/support/outcomes.h"

namespace skybake {
namespace {

struct Case {
    const char* name;
    std::function<void(PreviewOptions&)> give;
    bool sky;     // whether pictures of a sky use it
    bool clouds;  // whether pictures of a cloud do
};

const Case cases[] = {
    {"sun-elevation", [](PreviewOptions& options) { options.sun_elevations_deg = {3}; }, true,
     true},
    {"exposure", [](PreviewOptions& options) { options.exposure_stops = 0; }, true, true},
    {"tone-curve", [](PreviewOptions& options) { options.tone_curve = ToneCurve::agx; }, true,
     true},
    {"glare", [](PreviewOptions& options) { options.glare = Glare::none; }, true, false},
    {"altitude", [](PreviewOptions& options) { options.altitude_m = 0; }, true, false},
    {"sun-azimuth", [](PreviewOptions& options) { options.sun_azimuth_deg = 0; }, false, true},
    {"camera", [](PreviewOptions& options) { options.camera.emplace(); }, false, true},
    {"size",
     [](PreviewOptions& options) {
         options.picture_size = {16, 16};
     },
     false, true},
    {"single", [](PreviewOptions& options) { options.single = true; }, false, true},
    {"turntable", [](PreviewOptions& options) { options.turntable = 8; }, false, true},
    {"at", [](PreviewOptions& options) { options.at.emplace(); }, true, true},
    {"place", [](PreviewOptions& options) { options.place.emplace(); }, true, true},
};

TEST(UnusedOptions, AreThoseThatNoPictureUses) {
    for (const Case& one : cases) {
        PreviewOptions options;
        one.give(options);
        for (const bool sky : {false, true}) {
            for (const bool clouds : {false, true}) {
                const auto problems = unused_options({sky, clouds, false}, options);
                const bool used = (sky && one.sky) || (clouds && one.clouds);
                ASSERT_EQ(problems.size(), used ? 0U : 1U) << one.name << sky << clouds;
                if (used) continue;
                EXPECT_EQ(problems[0].code, "E0001");
                EXPECT_NE(problems[0].message.find(std::string("--") + one.name),
                          std::string::npos);
            }
        }
    }
    EXPECT_TRUE(unused_options({}, PreviewOptions{}).empty());
}

// A contact sheet shows the clouds of variants that have both, and has a size whatever it shows.
TEST(UnusedOptions, OfASweepAreThoseOfItsContactSheet) {
    PreviewOptions options;
    options.altitude_m = 100;
    EXPECT_TRUE(unused_options({true, false, true}, options).empty());
    EXPECT_EQ(unused_options({true, true, true}, options).size(), 1U);
    options = {};
    options.picture_size = {64, 64};
    EXPECT_TRUE(unused_options({false, false, true}, options).empty());
}

// A preview warns of what a recipe asks for in vain; a cloud's preset may ask for it.
TEST(UnusedKeys, AreThoseOfTheRecipeThatNoPictureUses) {
    const std::string table = "preset = 'earth_hillaire'\n[bake.transmittance]\nsize = [32, 8]\n";
    const std::string preview =
        "[preview]\nglare = 'none'\nexposure = 1\n[preview.camera]\nfov = '40 deg'\n";
    const std::string sky = table + "[bake.multiple_scattering]\nsize = [8, 8]\n";
    const std::string cloud = "[clouds.c]\npreset = 'cirrus'\n";
    const auto keys_of = [](const std::string& text) {
        std::string keys;
        const auto recipe = test::without_diagnostics(config::parse_recipe(text, "test.toml"));
        for (const config::Diagnostic& warning : unused_keys(recipe)) {
            EXPECT_EQ(warning.code, "W0216");
            EXPECT_EQ(warning.severity, config::Severity::warning);
            EXPECT_EQ(warning.where.source, "test.toml");
            keys += warning.message.substr(warning.message.find('`')) + ' ';
        }
        return keys;
    };
    EXPECT_EQ(keys_of(table + preview), "`preview.exposure` `preview.glare` `preview.camera.fov` ");
    EXPECT_EQ(keys_of(sky + preview), "`preview.camera.fov` ");
    EXPECT_EQ(keys_of(cloud + "[bake.c]\n" + preview), "`preview.glare` ");
    EXPECT_EQ(keys_of(table + cloud), "") << "the preset's camera";
}

PreviewAssets assets_of(int x, int y) {
    PreviewAssets assets;
    PreviewAsset& volume = assets.assets.emplace_back();
    volume.entry.kind = "cloud_volume";
    volume.entry.name = "c";
    volume.entry.size = {4, 4, 2};
    volume.entry.channels = {"Y"};
    volume.entry.levels.resize(1);
    volume.entry.levels[0].statistics.resize(1);
    volume.entry.levels[0].statistics[0].max = 1;
    volume.voxels.assign(32, 0);
    volume.voxels[static_cast<std::size_t>(16 + 4 * y + x)] = 0.5F;
    return assets;
}

TEST(CutClouds, ReachTheSidesOfASingleTile) {
    PreviewOptions options;
    options.single = true;
    EXPECT_TRUE(clouds_cut_by_tile(assets_of(1, 2), options).empty());
    for (const auto& [x, y] : {std::pair{0, 1}, {3, 1}, {1, 0}, {2, 3}}) {
        const auto warnings = clouds_cut_by_tile(assets_of(x, y), options);
        ASSERT_EQ(warnings.size(), 1U) << x << ' ' << y;
        EXPECT_EQ(warnings[0].code, "W0218");
    }
    EXPECT_TRUE(clouds_cut_by_tile(assets_of(0, 1), {}).empty()) << "the layer has no sides";
}

}  // namespace
}  // namespace skybake
