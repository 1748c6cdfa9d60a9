#include "config/presets/presets.h"
#include "config/sections/cloud.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "config/assets/multiple_scattering.h"
#include "config/sections/atmosphere.h"
#include "tests/config/recipes.h"
#include "tests/optics/columns.h"

namespace skybake::config {
namespace {

Parameters preset(const std::string& name) { return valid("preset = '" + name + "'").parameters; }

std::vector<double> per_meter(const std::vector<InverseLength>& coefficients) {
    std::vector<double> values;
    for (const InverseLength value : coefficients) values.push_back(value.per_meter);
    return values;
}

using Values = std::vector<double>;

TEST(Presets, AreThoseOfTheIssue) {
    EXPECT_EQ(preset_names(),
              (std::vector<std::string_view>{
                  "dense_earth", "earth", "earth_bruneton", "earth_clear_mountain",
                  "earth_desert_dust", "earth_hillaire", "earth_maritime", "earth_urban_haze",
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
    EXPECT_EQ(noise_preset_names(), (std::vector<std::string_view>{
                                        "billows", "fibres", "nubis_detail", "nubis_layer",
                                        "nubis_shape", "takram_detail", "takram_shape", "thesis"}));
    expect_titles(noise_presets());
}

TEST(Presets, OfCloudsAreThoseOfTheIssue) {
    EXPECT_EQ(cloud_preset_names(),
              (std::vector<std::string_view>{
                  "altocumulus", "cirrus", "cumulonimbus", "cumulus_congestus", "cumulus_humilis",
                  "cumulus_mediocris", "fog_bank", "stratocumulus", "stratus", "thesis"}));
    expect_titles(cloud_presets());
}

TEST(Presets, OfLayersAreLayersOfAnAtmosphere) {
    EXPECT_EQ(layer_preset_names(), (std::vector<std::string_view>{"dust", "fog", "rain", "snow"}));
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

// Its towers by their variances, as they are printed.
TEST(Presets, TheCloudOfTheThesisIsTheThesis) {
    const Cloud cloud = valid("[noise.shape]\npreset = 'thesis'\n[clouds.c]\npreset = 'thesis'\n")
                            .parameters.clouds.at(0);
    EXPECT_EQ(cloud.height_profile.type, HeightProfileType::thesis);
    EXPECT_EQ(cloud.height_profile.bottom_sharpness, 50);
    EXPECT_EQ(cloud.height_profile.top_falloff, 4);
    EXPECT_EQ(cloud.threshold, 0.35);
    EXPECT_EQ(cloud.edge_softness, 0.05);
    EXPECT_EQ(cloud.threshold_at, ThresholdAt::runtime);
    EXPECT_EQ(cloud.channels, CloudChannels::noise);
    EXPECT_EQ(cloud.coverage, 1);
    EXPECT_EQ(cloud.detail, "");
    for (const Length edge : cloud.extent) EXPECT_EQ(edge.meters, 600);
    const double expected[3][5] = {
        {0.4, 0.2, 0.3, 0.001, 0.004}, {0.4, 0.6, 0.4, 0.008, 0.01}, {0.2, 0.3, 0.8, 0.008, 0.002}};
    ASSERT_EQ(cloud.towers.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
        const Tower& tower = cloud.towers[i];
        EXPECT_EQ(tower.amplitude, expected[i][0]);
        EXPECT_EQ(tower.center[0], expected[i][1]);
        EXPECT_EQ(tower.center[1], expected[i][2]);
        EXPECT_NEAR(tower.sigma[0] * tower.sigma[0], expected[i][3], 1e-17);
        EXPECT_NEAR(tower.sigma[1] * tower.sigma[1], expected[i][4], 1e-17);
    }
}

// Number by number.
TEST(Presets, HillairesEarthHasHisNumbers) {
    const Parameters earth = preset("earth_hillaire");
    ASSERT_EQ(earth.wavelengths.size(), 3u);
    EXPECT_EQ(earth.wavelengths[0].meters, 680e-9);
    EXPECT_EQ(earth.wavelengths[1].meters, 550e-9);
    EXPECT_EQ(earth.wavelengths[2].meters, 440e-9);
    EXPECT_EQ(earth.atmosphere.ground_radius.meters, 6360e3);
    EXPECT_EQ(earth.atmosphere.top_radius.meters, 6460e3);
    EXPECT_EQ(earth.atmosphere.ground_albedo, Values(3, 0.3));
    ASSERT_EQ(earth.atmosphere.layers.size(), 3u);
    const Layer* rayleigh = find_layer(earth, "rayleigh");
    ASSERT_TRUE(rayleigh);
    EXPECT_EQ(rayleigh->profile, Profile::exponential);
    EXPECT_EQ(rayleigh->scale_height.meters, 8000);
    EXPECT_EQ(per_meter(rayleigh->scattering), (Values{5.802e-6, 1.3558e-5, 3.31e-5}));
    EXPECT_EQ(per_meter(rayleigh->extinction), (Values{5.802e-6, 1.3558e-5, 3.31e-5}));
    EXPECT_EQ(rayleigh->phase, Phase::rayleigh);
    const Layer* mie = find_layer(earth, "mie");
    ASSERT_TRUE(mie);
    EXPECT_EQ(mie->profile, Profile::exponential);
    EXPECT_EQ(mie->scale_height.meters, 1200);
    EXPECT_EQ(per_meter(mie->scattering), Values(3, 3.996e-6));
    EXPECT_EQ(per_meter(mie->extinction), Values(3, 4.44e-6));
    EXPECT_EQ(mie->phase, Phase::cornette_shanks);
    EXPECT_EQ(mie->g, 0.8);
    const Layer* ozone = find_layer(earth, "ozone");
    ASSERT_TRUE(ozone);
    EXPECT_EQ(ozone->profile, Profile::tent);
    EXPECT_EQ(ozone->center_altitude.meters, 25000);
    EXPECT_EQ(ozone->half_width.meters, 15000);
    EXPECT_EQ(per_meter(ozone->scattering), Values(3, 0));
    EXPECT_EQ(per_meter(ozone->extinction), (Values{6.5e-7, 1.881e-6, 8.5e-8}));
}

TEST(Presets, BrunetonFollowsHisFormula) {
    const Parameters parameters = preset("earth_bruneton");
    EXPECT_EQ(parameters.atmosphere.top_radius.meters, 6420e3);
    EXPECT_EQ(parameters.atmosphere.ground_albedo, Values(3, 0.1));
    const Layer* rayleigh = find_layer(parameters, "rayleigh");
    ASSERT_TRUE(rayleigh);
    for (std::size_t i = 0; i < 3; ++i) {
        const double micrometers = parameters.wavelengths[i].meters * 1e6;
        const double expected =
            1.24062e-6 / (micrometers * micrometers * micrometers * micrometers);
        EXPECT_NEAR(rayleigh->scattering[i].per_meter / expected, 1, 2e-5);
    }
}

TEST(Presets, DenseEarthHasFiftyTimesTheAir) {
    const Parameters earth = preset("earth_hillaire");
    const Parameters dense = preset("dense_earth");
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(find_layer(dense, "rayleigh")->scattering[i].per_meter /
                        find_layer(earth, "rayleigh")->scattering[i].per_meter,
                    50, 1e-10);
    }
    EXPECT_EQ(per_meter(find_layer(dense, "mie")->extinction), Values(3, 4.44e-6));
}

TEST(Presets, TinyPlanetHasEightTimesTheCoefficients) {
    const Parameters tiny = preset("tiny_planet");
    EXPECT_EQ(tiny.atmosphere.ground_radius.meters, 50e3);
    EXPECT_EQ(tiny.atmosphere.top_radius.meters, 65e3);
    EXPECT_EQ(tiny.atmosphere.ground_albedo, Values(3, 0));
    EXPECT_EQ(find_layer(tiny, "ozone"), nullptr);
    EXPECT_EQ(find_layer(tiny, "rayleigh")->scale_height.meters, 2000);
    EXPECT_EQ(find_layer(tiny, "mie")->scale_height.meters, 500);
    EXPECT_NEAR(find_layer(tiny, "rayleigh")->scattering[2].per_meter, 8 * 3.31e-5, 1e-15);
    EXPECT_NEAR(find_layer(tiny, "mie")->extinction[0].per_meter, 8 * 4.44e-6, 1e-15);
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

TEST(Presets, VacuumHasNoLayers) { EXPECT_TRUE(preset("vacuum").atmosphere.layers.empty()); }

}  // namespace
}  // namespace skybake::config
