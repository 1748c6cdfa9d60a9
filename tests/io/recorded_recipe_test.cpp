#include "bakers/io/manifest/metadata.h"
#include "config/sections/layer.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "config/presets/presets.h"
#include "tests/io/files.h"
#include "tests/support/outcomes.h"

namespace skybake {
namespace {

// All that files carry, one value a line.
std::string values_of(const config::Recipe& recipe) {
    std::string text;
    for (const config::ResolvedValue& value : recipe.values) {
        if (!value.only_shown) text += fmt::format("{} = {}\n", value.path, value.canonical);
    }
    return text;
}

// Through a manifest's text and back.
config::Outcome<config::Recipe> recorded(const config::Recipe& recipe) {
    const auto manifest = parse_manifest(manifest_json(new_manifest(recipe)), "manifest.json");
    EXPECT_TRUE(manifest.value.has_value());
    return recorded_recipe(*manifest.value, "manifest.json", "");
}

void expect_round_trip(const std::string& text) {
    SCOPED_TRACE(text);
    const auto recipe = test::without_errors(config::parse_recipe(text, "recipe.toml"));
    const auto again = test::without_errors(recorded(recipe));
    EXPECT_EQ(values_of(again), values_of(recipe));
    EXPECT_EQ(again.parameters.atmosphere.layers.size(),
              recipe.parameters.atmosphere.layers.size());
    EXPECT_EQ(again.parameters.bakes.size(), recipe.parameters.bakes.size());
}

TEST(RecordedRecipe, EveryAtmospherePresetComesBack) {
    for (const std::string_view preset : config::preset_names()) {
        expect_round_trip(fmt::format(
            "preset = \"{}\"\n[bake.transmittance]\n[bake.multiple_scattering]\n", preset));
    }
}

TEST(RecordedRecipe, WhatContradictsItsOwnResultDoesNot) {
    // `absorption` and `single_scattering_albedo` are recorded beside the extinction they made.
    expect_round_trip(R"(
preset = "earth_hillaire"
[atmosphere.layers.ozone]
enabled = false
[atmosphere.layers."sea fog"]
profile = "tabulated"
table = [["0 km", 1.0], ["0.4 km", 0.25], ["1 km", 0]]
scattering = "1e-4 /m"
single_scattering_albedo = 0.9
phase = "henyey_greenstein"
g = -0.3
[bake.transmittance]
max_error = "1 %"
content = "optical_depth"
[bake.small]
asset = "multiple_scattering"
method = "converged"
size = [16, 8]
)");
}

TEST(RecordedRecipe, NoisesAndCloudsComeBack) {
    for (const char* cloud : {"altocumulus", "cirrus", "stratus", "stratocumulus"}) {
        expect_round_trip(fmt::format(R"(
[noise.shape]
preset = "nubis_shape"
pack = "shape"
seed = "0xfedcba9876543210"
[noise.shape.channels.R]
octaves = 2
frequency = [4, 4, 2]
[noise.detail]
preset = "nubis_detail"
[clouds.c]
preset = "{}"
[[clouds.c.towers]]
center = [0.5, 0.4]
sigma = [0.09, 0.05]
rotation = "30 deg"
amplitude = 0.5
[clouds.c.coverage_map]
file = "maps/a b.png"
[bake.volume]
asset = "cloud_volume"
cloud = "c"
size = [512, 512, 128]
mips = "all"
[bake.grid]
asset = "occupancy"
of = "volume"
contents = ["leap", "occupied", "minimum"]
pixel_type = "unorm8"
formats = ["bin"]
[bake.shape]
asset = "noise_volume"
noise = "shape"
)",
                                      cloud));
    }
}

RC_GTEST_PROP(RecordedRecipe, AnyNumberComesBack, ()) {
    const double radius_m = 1e6 + *rc::gen::inRange(0, 1 << 30) / 1024.0;
    const double height_m = 1 + *rc::gen::inRange(0, 1 << 30) / 65536.0;
    const double coefficient = 1e-9 * *rc::gen::inRange(1, 1 << 30) / 3.0;
    const std::string text = fmt::format(
        "[atmosphere]\nground_radius = \"{} m\"\ntop_radius = \"{} m\"\nground_albedo = 0\n"
        "[atmosphere.layers.a]\n"
        "profile = \"exponential\"\nscale_height = \"{} m\"\nscattering = [\"{} /m\", \"0 /m\", "
        "\"1e-12 /m\"]\nabsorption = \"{} /m\"\n[bake.transmittance]\n",
        radius_m, radius_m + 1e5, height_m, coefficient, coefficient / 7);
    const auto recipe = config::parse_recipe(text, "recipe.toml");
    RC_ASSERT(recipe.value.has_value());
    const auto again = recorded(*recipe.value);
    RC_ASSERT(again.value.has_value());
    RC_ASSERT(values_of(*again.value) == values_of(*recipe.value));
}

// Another file of an include's name may lie in the folder of the bake.
TEST(RecordedRecipe, NeitherIncludesNorPresetsAreReadAgain) {
    const testing::TemporaryFolder folder;
    testing::write_bytes(folder / "air.toml", "[atmosphere]\nground_albedo = 0.125\n");
    testing::write_bytes(
        folder / "recipe.toml",
        "preset = \"earth_hillaire\"\ninclude = [\"air.toml\"]\n[bake.transmittance]\n");
    const auto recipe = config::load_recipe(folder / "recipe.toml", {});
    ASSERT_TRUE(recipe.value.has_value());
    const auto manifest =
        test::without_errors(parse_manifest(manifest_json(new_manifest(*recipe.value)), "m"));
    for (const char* found : {"[bake.intruder]\nasset = \"transmittance\"\n", "not a recipe"}) {
        testing::write_bytes(folder / "air.toml", found);
        const auto again = test::without_errors(recorded_recipe(manifest, "m", folder / ""));
        EXPECT_EQ(values_of(again), values_of(*recipe.value));
    }
}

TEST(RecordedRecipe, NonsenseIsDamage) {
    const auto code_of = [](const std::string& parameters) {
        Manifest manifest = new_manifest({});
        manifest.parameters = parameters;
        return testing::first_code(recorded_recipe(manifest, "manifest.json", "").diagnostics);
    };
    EXPECT_EQ(code_of(R"({"atmosphere": {"ground_radius": "many"}})"), "E0304");
    EXPECT_EQ(code_of(R"({"atmosphere": 3})"), "E0304");
    EXPECT_EQ(code_of(R"({"a\"]\n[b": {"x\ny": [{"]": null}]}})"), "E0304");
    EXPECT_EQ(code_of("[]"), "E0304");
}

}  // namespace
}  // namespace skybake
