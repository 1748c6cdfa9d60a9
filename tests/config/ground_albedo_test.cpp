// The ground's reflectance: numbers, spectra and measured grounds, at the recipe's wavelengths and at
// others.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "config/optics/ground_spectra.h"
#include "config/sections/spectral_air.h"
#include "tests/config/recipes.h"

namespace skybake::config {
namespace {

std::string planet(const std::string& albedo, const std::string& wavelengths = "'best 4'") {
    return "wavelengths = " + wavelengths +
           "\n[atmosphere]\nground_radius = '6371 km'\ntop_radius = '6471 km'\nground_albedo = " +
           albedo + "\n";
}

Atmosphere air(const std::string& albedo, const std::string& wavelengths = "'best 4'") {
    return valid(planet(albedo, wavelengths)).parameters.atmosphere;
}

constexpr Ground all_grounds[] = {Ground::vegetation, Ground::sand, Ground::snow, Ground::sea,
                                  Ground::mars};

double at_nm(Ground ground, double nm) { return albedo_at(spectrum_of(ground), {nm * 1e-9}); }

// The mean over the light of a black body of the sun's temperature.
double mean_in_sunlight(Ground ground, int first_nm, int last_nm) {
    double light = 0;
    double reflected = 0;
    for (int nm = first_nm; nm <= last_nm; ++nm) {
        const double power = std::pow(nm, -5) / std::expm1(1.4388e7 / (nm * 5772.0));
        light += power;
        reflected += power * at_nm(ground, nm);
    }
    return reflected / light;
}

TEST(GroundSpectra, AreSharesByAscendingWavelengths) {
    for (const Ground ground : all_grounds) {
        const std::vector<SpectrumPoint> spectrum = spectrum_of(ground);
        ASSERT_GE(spectrum.size(), 2u);
        EXPECT_LE(spectrum.front().wavelength.meters, 400.0001e-9);
        EXPECT_GE(spectrum.back().wavelength.meters, 699.9999e-9);
        for (std::size_t i = 0; i < spectrum.size(); ++i) {
            EXPECT_GT(spectrum[i].value, 0);
            EXPECT_LT(spectrum[i].value, 1);
            EXPECT_NEAR(albedo_at(spectrum, spectrum[i].wavelength), spectrum[i].value, 1e-15);
            if (i == 0) continue;
            EXPECT_GT(spectrum[i].wavelength.meters, spectrum[i - 1].wavelength.meters);
        }
    }
}

// Figures of other publications than those that the spectra are from.
TEST(GroundSpectra, AgreeWithOtherMeasurements) {
    // Lambert albedos of Pancam's mosaics, 400 to 1080 nm: 0.14 to 0.24 at Gusev (Reynolds et al. 2017,
    // GSA Annual Meeting, paper 319-4).
    const double mars = mean_in_sunlight(Ground::mars, 400, 1080);
    EXPECT_GT(mars, 0.14);
    EXPECT_LT(mars, 0.24);
    // Pure snow has 0.96 to 0.99 in visible light (Warren & Wiscombe 1980, J. Atmos. Sci. 37, 2734);
    // "nearly unity at 500 nm, slightly lower above" (Wuttke et al. 2006, Ann. Geophys. 24, 7).
    EXPECT_GT(at_nm(Ground::snow, 500), 0.98);
    EXPECT_GT(at_nm(Ground::snow, 700), 0.955);
    EXPECT_LT(at_nm(Ground::snow, 700), at_nm(Ground::snow, 500));
    // The sea has 0.05 to 0.1 under a clear sky, and is blue (Jin et al. 2004, Geophys. Res. Lett. 31).
    const double sea = mean_in_sunlight(Ground::sea, 400, 700);
    EXPECT_GT(sea, 0.05);
    EXPECT_LT(sea, 0.1);
    EXPECT_GT(at_nm(Ground::sea, 440), 1.2 * at_nm(Ground::sea, 680));
    // Leaves are green, and reflect about half beyond the red edge; fields and forests have 0.03 to
    // 0.15 in visible light (Monteith & Unsworth 2013, Principles of Environmental Physics, table 6.1).
    EXPECT_GT(at_nm(Ground::vegetation, 550), 1.5 * at_nm(Ground::vegetation, 450));
    EXPECT_GT(at_nm(Ground::vegetation, 550), 1.5 * at_nm(Ground::vegetation, 640));
    EXPECT_GT(at_nm(Ground::vegetation, 760), 0.4);
    EXPECT_LT(mean_in_sunlight(Ground::vegetation, 400, 680), 0.15);
    EXPECT_GT(at_nm(Ground::sand, 650), 1.5 * at_nm(Ground::sand, 450));
}

TEST(GroundAlbedo, PairsAreLinearBetweenAndConstantBeyond) {
    const std::string pairs = "[['450 nm', 0.07], ['650 nm', '25 %']]";
    const Atmosphere found = air(pairs, "['400 nm', '450 nm', '500 nm', '650 nm', '700 nm']");
    ASSERT_EQ(found.ground_albedo.size(), 5u);
    EXPECT_EQ(found.ground_albedo[0], 0.07);
    EXPECT_NEAR(found.ground_albedo[1], 0.07, 1e-15);
    EXPECT_NEAR(found.ground_albedo[2], 0.115, 1e-15);
    EXPECT_NEAR(found.ground_albedo[3], 0.25, 1e-15);
    EXPECT_EQ(found.ground_albedo[4], 0.25);
    EXPECT_EQ(air(pairs, "['550 nm']").ground_albedo.size(), 1u);
}

TEST(GroundAlbedo, AGroundIsItsSpectrumAtTheRecipesWavelengths) {
    for (const char* wavelengths : {"'best 4'", "'best 16'", "['680 nm', '550 nm', '440 nm']"}) {
        const Recipe recipe = valid(planet("'vegetation'", wavelengths));
        const std::vector<double>& albedo = recipe.parameters.atmosphere.ground_albedo;
        ASSERT_EQ(albedo.size(), recipe.parameters.wavelengths.size());
        for (std::size_t i = 0; i < albedo.size(); ++i) {
            EXPECT_EQ(albedo[i],
                      albedo_at(spectrum_of(Ground::vegetation), recipe.parameters.wavelengths[i]));
        }
        EXPECT_EQ(value_at(recipe, "atmosphere.ground_albedo").canonical, "\"vegetation\"");
    }
}

// Between a recipe's wavelengths its numbers are all that is known; a spectrum knows more.
TEST(GroundAlbedo, ASpectrumIsKnownAtOtherWavelengths) {
    const std::vector<Length> given = {{445e-9}, {636e-9}};
    const std::vector<Length> wanted = {{550e-9}, {750e-9}};
    const Atmosphere green =
        atmosphere_at(air("'vegetation'", "['445 nm', '636 nm']"), given, wanted);
    EXPECT_EQ(green.ground_albedo[0], at_nm(Ground::vegetation, 550));
    EXPECT_EQ(green.ground_albedo[1], at_nm(Ground::vegetation, 750));
    const Atmosphere numbers =
        atmosphere_at(air("[0.078, 0.074]", "['445 nm', '636 nm']"), given, wanted);
    EXPECT_LT(numbers.ground_albedo[0], 0.08);
    EXPECT_EQ(numbers.ground_albedo[1], 0.074);
}

TEST(GroundAlbedo, ComesBackFromWhatFilesCarry) {
    for (const char* albedo : {"'mars'", "[['450 nm', 0.07], ['650.5 nm', 0.25]]", "0.125"}) {
        const Recipe recipe = valid(planet(albedo));
        EXPECT_EQ(air(value_at(recipe, "atmosphere.ground_albedo").canonical),
                  recipe.parameters.atmosphere);
    }
}

}  // namespace
}  // namespace skybake::config
