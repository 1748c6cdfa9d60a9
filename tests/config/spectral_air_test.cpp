// Layers of gases and aerosols, and air at other wavelengths than the recipe's.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "config/sections/atmosphere.h"
#include "config/sections/layer.h"
#include "config/sections/spectral_air.h"
#include "tests/config/recipes.h"

namespace skybake::config {

namespace {

const std::string planet =
    "[atmosphere]\nground_radius = '6371 km'\ntop_radius = '6471 km'\nground_albedo = 0\n";
const std::string exponential = "profile = 'exponential'\nscale_height = '8 km'\n";

std::vector<double> depths(const std::string& layer) {
    const Recipe recipe = valid(planet + "[atmosphere.layers.it]\n" + layer);
    return zenith_optical_depth(*find_layer(recipe.parameters, "it"), recipe.parameters.atmosphere);
}

// Bucholtz 1995 over 2.148e29 molecules per square metre.
TEST(Gases, AirHasItsMeasuredDepthOverAnyProfile) {
    for (const std::string& profile : {exponential, std::string("profile = 'standard'\n")}) {
        const std::vector<double> found = depths("gas = 'air'\nphase = 'rayleigh'\n" + profile);
        EXPECT_NEAR(found[0], 0.0409, 1e-3 * 0.0409);
        EXPECT_NEAR(found[1], 0.0968, 1e-3 * 0.0968);
        EXPECT_NEAR(found[2], 0.2423, 1e-3 * 0.2423);
    }
    const std::vector<double> high = depths(
        "gas = 'air'\npressure = '506.625 hPa'\n"
        "phase = 'rayleigh'\n" +
        exponential);
    EXPECT_NEAR(high[1], 0.0484, 1e-3 * 0.0484);
}

// The spectrum of ozone's absorption at 233 K as CalcMySky has it, 300 DU.
TEST(Gases, OzoneHasItsMeasuredDepth) {
    const std::vector<double> found =
        depths("gas = 'ozone'\ncolumn = '300 DU'\nprofile = 'standard'\n");
    EXPECT_NEAR(found[0], 0.0106275, 1e-3 * 0.0106275);
    EXPECT_NEAR(found[1], 0.0264733, 1e-3 * 0.0264733);
    EXPECT_NEAR(found[2], 0.00106787, 1e-3 * 0.00106787);
}

TEST(Gases, AirScattersAllThatItTakesAndIsDepolarised) {
    const Recipe recipe = valid(planet + "[atmosphere.layers.air]\ngas = 'air'\n" +
                                "phase = 'rayleigh'\n" + exponential);
    const Layer& air = *find_layer(recipe.parameters, "air");
    EXPECT_EQ(air.scattering, air.extinction);
    EXPECT_EQ(air.depolarization, 0.0279);
    const Layer& plain = *find_layer(
        valid(planet + "[atmosphere.layers.a]\nphase = 'rayleigh'\n" + exponential).parameters,
        "a");
    EXPECT_EQ(plain.depolarization, 0);
}

TEST(Aerosols, FollowAngstromsLaw) {
    const std::vector<double> found =
        depths("optical_depth = 0.1\nangstrom_exponent = 2\n" + exponential);
    EXPECT_NEAR(found[1], 0.1, 1e-12);
    EXPECT_NEAR(found[0], 0.1 * std::pow(550.0 / 680, 2), 1e-12);
    EXPECT_NEAR(found[2], 0.1 * std::pow(550.0 / 440, 2), 1e-12);
}

TEST(Aerosols, HazeOfAVisibilityAndTheAirTogetherObeyKoschmieder) {
    const Recipe recipe = valid(planet + "[atmosphere.layers.haze]\nvisibility = '10 km'\n" +
                                "single_scattering_albedo = 0.9\n" + exponential);
    const Layer& haze = *find_layer(recipe.parameters, "haze");
    EXPECT_NEAR(haze.extinction[1].per_kilometer() + 0.01162, 0.3912, 1e-9);
    EXPECT_NEAR(haze.scattering[1].per_meter, 0.9 * haze.extinction[1].per_meter, 1e-18);
    // Files carry the albedo, which their extinction does not tell.
    EXPECT_TRUE(testing::has_value(recipe, "atmosphere.layers.haze.single_scattering_albedo"));
}

// A transmittance is made from no phase function, so that its file does not carry it.
TEST(Gas, ScattersByRayleighsLawWhereNothingIsSaid) {
    const std::string air =
        "[atmosphere.layers.air]\ngas = 'air'\nprofile = 'exponential'\n"
        "scale_height = '8 km'\n";
    const Recipe recipe = valid(planet + air);
    ASSERT_EQ(recipe.parameters.atmosphere.layers.size(), 1u);
    EXPECT_EQ(recipe.parameters.atmosphere.layers[0].phase, Phase::rayleigh);
    EXPECT_EQ(recipe.parameters.atmosphere,
              valid(planet + air + "phase = 'rayleigh'\n").parameters.atmosphere);
}

// --- At other wavelengths ------------------------------------------------------------------------

TEST(AtmosphereAt, NumbersFollowThePowerLawBetweenThem) {
    const Recipe recipe = valid(planet.substr(0, planet.find("ground_albedo")) +
                                "ground_albedo = [0.4, 0.2, 0.1]\n[atmosphere.layers.a]\n"
                                "scattering = ['1e-6 /m', '2e-6 /m', '4e-6 /m']\n" +
                                exponential);
    const Parameters& given = recipe.parameters;
    const std::vector<Length> others = {{440e-9}, {495e-9}, {550e-9}, {615e-9}, {680e-9}, {780e-9}};
    const Atmosphere at = atmosphere_at(given.atmosphere, given.wavelengths, others);
    const auto scattering = [&](std::size_t i) { return at.layers[0].scattering[i].per_meter; };
    EXPECT_NEAR(scattering(0), 4e-6, 1e-18);
    EXPECT_NEAR(scattering(2), 2e-6, 1e-18);
    EXPECT_NEAR(scattering(4), 1e-6, 1e-18);
    EXPECT_NEAR(scattering(1), 4e-6 * std::pow(495.0 / 440, std::log(0.5) / std::log(1.25)), 1e-15);
    EXPECT_LT(scattering(5), 1e-6);
    EXPECT_NEAR(at.ground_albedo[1], 0.15, 1e-12);
    EXPECT_EQ(at.ground_albedo[5], 0.4);
}

TEST(AtmosphereAt, GasesAreLookedUp) {
    const std::string air =
        "[atmosphere.layers.air]\ngas = 'air'\nphase = 'rayleigh'\n" + exponential;
    const Parameters given = valid(planet + air).parameters;
    const Parameters wanted =
        valid("wavelengths = ['500 nm', '600 nm']\n" + planet + air).parameters;
    EXPECT_EQ(atmosphere_at(given.atmosphere, given.wavelengths, wanted.wavelengths),
              wanted.atmosphere);
}

TEST(ChannelsOf, AreThoseWavelengthsOnly) {
    const Parameters given =
        valid(planet + "[atmosphere.layers.a]\nscattering = ['1e-6 /m', '2e-6 /m', '4e-6 /m']\n" +
              exponential)
            .parameters;
    const Atmosphere part = channels_of(given.atmosphere, 1, 2);
    EXPECT_EQ(part.ground_albedo.size(), 2u);
    EXPECT_EQ(part.layers[0].scattering, (std::vector<InverseLength>{{2e-6}, {4e-6}}));
}

constexpr Length thickness{100e3};

TEST(ZenithOpticalDepth, Exponential) {
    Layer layer;
    layer.scale_height = {8000};
    EXPECT_NEAR(density_column(layer, thickness), 8000 * (1 - std::exp(-12.5)), 1e-9);
    // Where the air is far thinner than its scale height the column is its thickness.
    layer.scale_height = {1e9};
    EXPECT_NEAR(density_column(layer, Length{1}), 1, 1e-9);
}

TEST(ZenithOpticalDepth, TentCutAtGroundAndTop) {
    Layer layer;
    layer.profile = Profile::tent;
    layer.center_altitude = {25e3};
    layer.half_width = {15e3};
    EXPECT_DOUBLE_EQ(density_column(layer, thickness), 15e3);
    EXPECT_DOUBLE_EQ(density_column(layer, Length{25e3}), 7.5e3);
    layer.center_altitude = {0};
    EXPECT_DOUBLE_EQ(density_column(layer, thickness), 7.5e3);
    layer.center_altitude = {-7.5e3};
    EXPECT_DOUBLE_EQ(density_column(layer, thickness), 0.5 * 7.5e3 * 0.5);
    layer.center_altitude = {-20e3};
    EXPECT_EQ(density_column(layer, thickness), 0);
}

TEST(ZenithOpticalDepth, SlabCutAtGroundAndTop) {
    Layer layer;
    layer.profile = Profile::slab;
    layer.bottom_altitude = {-1e3};
    layer.top_altitude = {2e3};
    EXPECT_DOUBLE_EQ(density_column(layer, thickness), 2e3);
    layer.top_altitude = {1e9};
    EXPECT_DOUBLE_EQ(density_column(layer, thickness), 100e3);
    layer.bottom_altitude = {200e3};
    EXPECT_EQ(density_column(layer, thickness), 0);
}

TEST(ZenithOpticalDepth, Tabulated) {
    Layer layer;
    layer.profile = Profile::tabulated;
    layer.table = {{{0}, 1}, {{1000}, 3}, {{2000}, 0}};
    EXPECT_DOUBLE_EQ(density_column(layer, thickness), 2000 + 1500);
    EXPECT_DOUBLE_EQ(density_column(layer, Length{500}), 500 * 1.5);
}

TEST(ZenithOpticalDepth, MultipliesByExtinction) {
    Layer layer;
    layer.profile = Profile::slab;
    layer.bottom_altitude = {0};
    layer.top_altitude = {1000};
    layer.extinction = {{1e-3}, {2e-3}, {0}};
    Atmosphere atmosphere;
    atmosphere.ground_radius = {1e6};
    atmosphere.top_radius = {1.1e6};
    atmosphere.ground_albedo = {0, 0, 0};
    EXPECT_EQ(zenith_optical_depth(layer, atmosphere), (std::vector<double>{1, 2, 0}));
}

}  // namespace

}  // namespace skybake::config
