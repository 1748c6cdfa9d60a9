// Every preset of an atmosphere bakes every asset of the air with the defaults of its keys: no
// default asks for an accuracy that the asset's quadratures do not reach.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "bakers/assets/registry/registry.h"
#include "bakers/assets/sky/traced_light.h"
#include "config/presets/presets.h"
#include "config/sections/layer.h"
#include "tests/support/atmospheres.h"
#include "tests/support/shared_bakes.h"

namespace skybake::test {
namespace {

// Sizes are small, and keys without a default are given; everything else is as it is by default.
constexpr const char* all_assets = R"(
[bake.transmittance]
size = [16, 8]
[bake.multiple_scattering]
[bake.sky_view]
size = [16, 16]
altitude = "0.5 m"
sun_elevations = ["10 deg"]
[bake.environment]
size = [16, 8]
altitude = "0.5 m"
sun_elevation = "10 deg"
[bake.aerial_perspective]
size = [4, 4, 4]
altitude = "0.5 m"
sun_elevation = "10 deg"
[bake.irradiance]
size = [8, 4]
[bake.bruneton]
size = [32, 16, 4]
)";
constexpr const char* of_layers = "[bake.optical_depth]\nsize = [16, 8, 1]\n";

// The wavelengths that all assets can hold.
const std::vector<std::string> three = {"wavelengths=[\"680 nm\", \"550 nm\", \"440 nm\"]"};

class PresetDefaults : public ::testing::TestWithParam<std::string_view> {};

TEST_P(PresetDefaults, BakeEveryAsset) {
    std::string text = "preset = \"" + std::string(GetParam()) + "\"\n" + all_assets;
    const bool has_layers =
        !recipe_of(text, three).parameters.atmosphere.layers.empty();  // the vacuum has none
    if (has_layers) text += of_layers;
    const config::Recipe recipe = recipe_of(text, three);
    ASSERT_EQ(recipe.parameters.bakes.size(), has_layers ? 8U : 7U);
    SharedBakes bakes;
    for (const config::Bake& bake : recipe.parameters.bakes) {
        const auto baked = bakes.outcome(recipe, bake);
        EXPECT_TRUE(baked.value) << bake.name;
        for (const config::Diagnostic& found : baked.diagnostics) {
            EXPECT_EQ(found.severity, config::Severity::warning)
                << bake.name << ": " << found.message;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(AllPresets, PresetDefaults, ::testing::ValuesIn(config::preset_names()),
                         [](const auto& of) { return std::string(of.param); });

// Moments do not hold the light of its dust: the preset bakes what does, and a table of it says so.
TEST(Mars, SaysWhatShowsItsDustRight) {
    const std::string preset(config::find_preset("mars")->text);
    EXPECT_EQ(preset.find("[bake.multiple_scattering]"), std::string::npos);
    const config::Recipe mars = recipe_of(preset + "[bake.multiple_scattering]\n");
    std::vector<std::string> kinds;
    std::string better;
    for (const config::Bake& bake : mars.parameters.bakes) {
        const AnyBaker& baker = baker_of(bake);
        kinds.emplace_back(baker.asset);
        if (bake.name != "multiple_scattering") continue;
        const auto traced = baker.traced(mars.parameters, bake);
        ASSERT_TRUE(traced);
        better = traced->better;
    }
    for (const char* right : {"bruneton", "sky_view"}) {
        EXPECT_NE(std::find(kinds.begin(), kinds.end(), right), kinds.end());
        EXPECT_NE(better.find(right), std::string::npos) << better;
    }
    // Haze of a closed form is held by moments, which is what a table of the mean says.
    std::string text(config::find_preset("earth")->text);
    const std::string moments = "content = \"moments\"\n";
    ASSERT_NE(text.find(moments), text.npos);
    text.erase(text.find(moments), moments.size());
    const config::Recipe earth = recipe_of(text);
    for (const config::Bake& bake : earth.parameters.bakes) {
        if (bake.name != "multiple_scattering") continue;
        EXPECT_NE(baker_of(bake).traced(earth.parameters, bake)->better.find("moments"),
                  std::string::npos);
    }
}

}  // namespace
}  // namespace skybake::test
