#include "config/presets/presets.h"
#include "config/sections/cloud.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "config/assets/multiple_scattering.h"
#include "config/assets/noise_volume.h"
#include "config/sections/atmosphere.h"
#include "tests/config/noises.h"
#include "tests/optics/columns.h"

namespace skybake::config {
namespace {

using PresetNames = std::vector<std::string_view>;

Parameters preset(const std::string& name) { return valid("preset = '" + name + "'").parameters; }

TEST(Presets, AreThoseOfTheIssue) {
    EXPECT_EQ(preset_names(), (PresetNames{"dense_earth", "earth", "earth_bruneton",
                                           "earth_clear_mountain", "earth_desert_dust",
                                           "earth_hillaire", "earth_maritime", "earth_urban_haze",
                                           "mars", "mars_rgb", "takram", "tiny_planet", "vacuum"}));
    EXPECT_EQ(find_preset("moon"), nullptr);
}

// A newcomer's first bake is the best that there is; whoever must match a runtime asks for it.
TEST(Presets, TheEarthHasItsLightSolved) {
    const auto second_order = [](const char* preset) {
        const Recipe recipe = valid(std::string(find_preset(preset)->text));
        return recipe.parameters.bakes.at(1).as<MultipleScatteringBake>();
    };
    for (const char* preset : {"earth", "earth_urban_haze"}) {
        EXPECT_EQ(second_order(preset).method, MultipleScatteringMethod::solved) << preset;
        EXPECT_EQ(second_order(preset).mapping, MultipleScatteringMapping::twilight) << preset;
    }
    EXPECT_EQ(second_order("earth_hillaire").method, MultipleScatteringMethod::converged);
    EXPECT_EQ(second_order("earth_hillaire").mapping, MultipleScatteringMapping::hillaire);
}

TEST(Presets, VacuumHasNoLayers) { EXPECT_TRUE(preset("vacuum").atmosphere.layers.empty()); }

// Zenith optical depths at a wavelength of 550 nm against the figures of the sources: 0.0968 (Bucholtz),
// 0.02647 for 300 DU of ozone, and 0.151 (OPAC, continental average).
TEST(Presets, TheEarthHasMeasuredAir) {
    const Recipe recipe = valid(std::string(find_preset("earth")->text),
                                {"wavelengths=[\"680 nm\", \"550 nm\", \"440 nm\"]"});
    const auto depth = [&](const char* layer) {
        return zenith_optical_depth(*find_layer(recipe.parameters, layer),
                                    recipe.parameters.atmosphere)[1];
    };
    EXPECT_NEAR(depth("air") / 0.0968, 1, 2e-3);
    EXPECT_NEAR(depth("ozone") / (0.02647 / 300 * 345), 1, 1e-3);
    EXPECT_NEAR(depth("aerosol"), 0.151, 1e-6);
    EXPECT_EQ(preset("earth").wavelengths.size(), 4U);
}

// Dusk is made by the air at 30 to 60 km, of which an exponential of 8 km has twice as much. At 40 km the
// US Standard Atmosphere 1976 has 3.9957e-3 kg/m3, under 10 332 kg/m2 of air.
TEST(Presets, MeasuredEarthsHaveTheStandardProfiles) {
    for (const char* name : {"earth", "earth_clear_mountain", "earth_desert_dust", "earth_maritime",
                             "earth_urban_haze"}) {
        const Parameters parameters = preset(name);
        for (const char* gas : {"air", "ozone"}) {
            const Layer& layer = *find_layer(parameters, gas);
            const auto standard = standard_profile(layer.gas->gas);
            ASSERT_EQ(layer.table.size(), standard.size()) << name;
            EXPECT_EQ(layer.table.at(5).density, standard[5].relative_density) << name;
        }
    }
    const auto air = standard_profile(Gas::air);
    EXPECT_NEAR(profile_at(air, 40e3) / profile_depth_m(air) / (3.9957e-3 / 10332), 1, 0.01);
}

TEST(Presets, TheExampleIsThePreset) {
    std::ifstream file(SKYBAKE_EXAMPLES "/earth.toml");
    const std::string text((std::istreambuf_iterator<char>(file)), {});
    EXPECT_EQ(text, find_preset("earth")->text);
}

TEST(Presets, AreValidRecipesWithATitleAndBakes) {
    for (const Preset& entry : presets()) {
        const Recipe recipe = valid(std::string(entry.text));
        // takram's are the four textures that its loader wants; measured air has a sky besides.
        const bool has_sky = recipe.parameters.color.has_value();
        const std::size_t bakes = entry.name == "takram" ? 4 : has_sky ? 3 : 2;
        EXPECT_EQ(recipe.parameters.bakes.size(), bakes) << entry.name;
        EXPECT_TRUE(entry.text.starts_with("# ")) << entry.name;
        EXPECT_FALSE(preset_title(entry).empty()) << entry.name;
        EXPECT_LE(preset_title(entry).size(), 80u) << entry.name;
    }
}

void expect_titles(std::span<const Preset> presets) {
    for (const Preset& entry : presets) {
        EXPECT_EQ(find_preset(entry.name), nullptr) << entry.name;
        EXPECT_TRUE(entry.text.starts_with("# ")) << entry.name;
        EXPECT_FALSE(preset_title(entry).empty()) << entry.name;
        EXPECT_LE(preset_title(entry).size(), 100u) << entry.name;
    }
}

TEST(Presets, OfNoisesAreThoseOfTheIssue) {
    EXPECT_EQ(preset_names(noise_presets()),
              (PresetNames{"billows", "nubis_detail", "nubis_layer", "nubis_shape", "takram_detail",
                           "takram_shape", "thesis", "tufts"}));
    expect_titles(noise_presets());
}

TEST(Presets, OfCloudsAreThoseOfTheIssue) {
    EXPECT_EQ(preset_names(cloud_presets()),
              (PresetNames{"altocumulus", "cirrus", "cumulonimbus", "cumulus_congestus",
                           "cumulus_humilis", "cumulus_mediocris", "fog_bank", "stratocumulus",
                           "stratus", "thesis"}));
    expect_titles(cloud_presets());
}

TEST(Presets, OfLayersAreLayersOfAnAtmosphere) {
    EXPECT_EQ(preset_names(layer_presets()), (PresetNames{"dust", "fog", "rain", "snow"}));
    for (const Preset& entry : layer_presets()) {
        const std::string name(entry.name);
        const Recipe recipe =
            valid("preset = 'earth_hillaire'\n[atmosphere.layers.weather]\npreset = '" + name +
                  "'\ng = 0.5\n");
        const Layer& layer = recipe.parameters.atmosphere.layers.back();
        EXPECT_EQ(layer.name, "weather");
        EXPECT_GT(layer.extinction.at(0).per_meter, 1e-4) << name;
        EXPECT_EQ(layer.g, 0.5) << name;  // the recipe's own keys lie over the preset's
        EXPECT_TRUE(entry.text.starts_with("# ")) << name;
        EXPECT_LE(preset_title(entry).size(), 100u) << name;
    }
    EXPECT_EQ(valid("preset = 'earth_hillaire'\n").parameters.atmosphere.layers.size() + 1,
              valid("preset = 'earth_hillaire'\n[atmosphere.layers.fog]\npreset = 'fog'\n")
                  .parameters.atmosphere.layers.size());
    const auto unknown = parse_recipe(
        "preset = 'earth_hillaire'\n[atmosphere.layers.fog]\npreset = 'fogg'\n", "test.toml");
    ASSERT_FALSE(unknown.diagnostics.empty());
    EXPECT_EQ(unknown.diagnostics.front().code, "E0115");
    EXPECT_NE(unknown.diagnostics.front().label.find("fog"), std::string::npos);
}

TEST(Presets, BrunetonFollowsHisFormula) {
    const Parameters parameters = preset("earth_bruneton");
    EXPECT_EQ(parameters.atmosphere.top_radius.meters, 6420e3);
    EXPECT_EQ(parameters.atmosphere.ground_albedo, std::vector<double>(3, 0.1));
    const Layer* rayleigh = find_layer(parameters, "rayleigh");
    ASSERT_TRUE(rayleigh);
    for (std::size_t i = 0; i < 3; ++i) {
        const double micrometers = parameters.wavelengths[i].meters * 1e6;
        const double expected =
            1.24062e-6 / (micrometers * micrometers * micrometers * micrometers);
        EXPECT_NEAR(rayleigh->scattering[i].per_meter / expected, 1, 2e-5);
    }
}

TEST(Presets, MarsHasDustOfDepthOneHalf) {
    const Parameters mars = preset("mars_rgb");
    const Layer* dust = find_layer(mars, "dust");
    ASSERT_TRUE(dust);
    for (const double depth : zenith_optical_depth(*dust, mars.atmosphere))
        EXPECT_NEAR(depth, 0.5, 1e-3);
    EXPECT_NEAR(dust->scattering[2].per_meter / dust->extinction[2].per_meter, 0.76, 1e-12);
    EXPECT_EQ(dust->g, 0.65);
}

// Skies of measured spheres are colours of any wavelengths.
TEST(Presets, OfMeasuredSpheresTakeAnyWavelengths) {
    for (const char* name : {"earth_maritime", "earth_desert_dust", "earth_urban_haze", "mars"}) {
        EXPECT_EQ(preset(name).wavelengths.size(), 4U) << name;
        const Recipe recipe = valid(std::string(find_preset(name)->text), {"wavelengths='best 3'"});
        const Layer* spheres =
            find_layer(recipe.parameters, std::string(name) == "mars" ? "dust" : "aerosol");
        ASSERT_TRUE(spheres) << name;
        EXPECT_EQ(spheres->phase, Phase::mie) << name;
        EXPECT_EQ(spheres->particles.wavelengths.size(), 3U) << name;
    }
}

TEST(NoisePresets, TheExampleIsWithoutFault) {
    const auto outcome = load_recipe(SKYBAKE_EXAMPLES "/clouds_noise.toml");
    EXPECT_TRUE(outcome.diagnostics.empty());
    ASSERT_TRUE(outcome.value);
    const Parameters& parameters = outcome.value->parameters;
    ASSERT_EQ(parameters.bakes.size(), 2u);
    const auto& shape = parameters.bakes[0].as<NoiseVolumeBake>();
    const auto& detail = parameters.bakes[1].as<NoiseVolumeBake>();
    EXPECT_EQ(testing::to_string(shape), "shape [128, 128, 128] 1 0 0 1 1 2 0");
    EXPECT_EQ(testing::to_string(detail), "detail [32, 32, 32] 1 0 0 1 1 2 0");
}

// Presets that copy a source which aliases say so in their keys, not in a warning.
TEST(NoisePresets, BakeAtTheirSize) {
    for (const Preset& entry : noise_presets()) {
        const auto outcome = testing::parse("[noise.n]\npreset = '" + std::string(entry.name) +
                                            "'\n[bake.n]\nasset = 'noise_volume'\nnoise = 'n'\n");
        ASSERT_TRUE(outcome.value) << entry.name;
        const auto& bake = outcome.value->parameters.bakes.at(0).as<NoiseVolumeBake>();
        EXPECT_EQ(bake.size, outcome.value->parameters.noises.at(0).size);
        EXPECT_TRUE(outcome.diagnostics.empty()) << entry.name;
    }
}

}  // namespace
}  // namespace skybake::config
