// `wavelengths`, [color], and which assets can hold them.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "config/assets/asset_kind.h"
#include "config/assets/bruneton.h"
#include "config/sections/color.h"
#include "config/sections/frames.h"
#include "tests/config/recipes.h"

namespace skybake::config {
namespace {

const std::string grey_air =
    "preset = 'vacuum'\n\n\n"
    "[atmosphere.layers.air]\nprofile = 'exponential'\nscale_height = '8 km'\n"
    "scattering = '1e-5 /m'\n";

std::vector<double> nm_of(const std::string& wavelengths) {
    std::vector<double> nm;
    for (const Length wavelength :
         valid("wavelengths = " + wavelengths + "\n" + grey_air).parameters.wavelengths) {
        nm.push_back(wavelength.meters * 1e9);
    }
    return nm;
}

TEST(Wavelengths, BestOnesAscendAndSpanWhatEyesSee) {
    for (const int count : {3, 4, 8, 16}) {
        const std::vector<double> nm = nm_of("'best " + std::to_string(count) + "'");
        ASSERT_EQ(nm.size(), static_cast<std::size_t>(count));
        EXPECT_TRUE(std::is_sorted(nm.begin(), nm.end()));
        EXPECT_GT(nm.front(), 380);
        EXPECT_LT(nm.front(), 460);
        EXPECT_GT(nm.back(), 600);
        EXPECT_LT(nm.back(), 720);
    }
    EXPECT_EQ(nm_of("'best 4'"), nm_of("['446 nm', '524 nm', '577 nm', '642 nm']"));
}

TEST(Wavelengths, RangesHaveBothEnds) {
    const std::vector<double> nm = nm_of("'380 nm..780 nm by 5 nm'");
    ASSERT_EQ(nm.size(), 81u);
    EXPECT_DOUBLE_EQ(nm.front(), 380);
    EXPECT_NEAR(nm[1], 385, 1e-9);
    EXPECT_NEAR(nm.back(), 780, 1e-9);
    EXPECT_EQ(nm_of("'0.4 um..450 nm by 20 nm'").size(), 3u);
}

TEST(Color, IsThereWhereTheRecipeAsksForIt) {
    EXPECT_FALSE(valid(grey_air).parameters.color);
    EXPECT_EQ(valid("wavelengths = 'best 4'\n" + grey_air).parameters.color, Color{});
    const Recipe recipe = valid(grey_air + "[color]\nspace = 'acescg'\nsun = 'flat'\n");
    ASSERT_TRUE(recipe.parameters.color);
    EXPECT_EQ(recipe.parameters.color->space, ColorSpace::acescg);
    EXPECT_EQ(recipe.parameters.color->sun, SunSpectrum::flat);
    EXPECT_EQ(recipe.parameters.color->white, WhitePoint::sun);
}

const std::string sky = "[bake.sky_view]\nsun_elevations = ['30 deg']\n";
const std::string matrix = "[bake.transmittance]\n";
const std::string none = "[color]\nspace = 'none'\n";

// --- Packets -------------------------------------------------------------------------------------

using Names = std::vector<std::string>;

Names names_of(const Recipe& recipe) {
    Names names;
    for (const Bake& bake : recipe.parameters.bakes) names.push_back(bake.name);
    return names;
}

TEST(Packets, HoldFourWavelengthsEach) {
    const auto names = [](const std::string& wavelengths, const std::string& color) {
        return names_of(valid("wavelengths = " + wavelengths + "\n" + grey_air + color + sky +
                              matrix + "[bake.noise_volume]\nnoise = 'n'\nsize = [8, 8, 8]\n" +
                              "[noise.n.channels.Y]\ntype = 'worley'\nfrequency = 1\n"));
    };
    EXPECT_EQ(names("'best 8'", none), (Names{"sky_view_1", "sky_view_2", "transmittance_1",
                                              "transmittance_2", "noise_volume"}));
    EXPECT_EQ(names("'best 8'", ""),
              (Names{"sky_view", "transmittance_1", "transmittance_2", "noise_volume"}));
    EXPECT_EQ(names("'best 4'", none), (Names{"sky_view", "transmittance", "noise_volume"}));
    EXPECT_EQ(
        names("'500 nm..540 nm by 10 nm'", ""),
        (Names{"sky_view_1", "sky_view_2", "transmittance_1", "transmittance_2", "noise_volume"}));
}

TEST(Packets, HaveTheAirOfTheirOwnWavelengths) {
    const std::string air =
        "[atmosphere]\nground_radius = '6360 km'\ntop_radius = '6420 km'\n"
        "ground_albedo = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6]\n"
        "[atmosphere.layers.air]\nprofile = 'exponential'\nscale_height = '8 km'\n"
        "scattering = ['1 /km', '2 /km', '3 /km', '4 /km', '5 /km', '6 /km']\n";
    const Recipe recipe = valid("wavelengths = '500 nm..550 nm by 10 nm'\n" + air + matrix);
    ASSERT_EQ(names_of(recipe), (Names{"transmittance_1", "transmittance_2"}));
    const Bake& bake = recipe.parameters.bakes[1];
    EXPECT_EQ(packet_number(bake), 2);
    const Parameters own = packet_of(recipe.parameters, packet_number(bake));
    ASSERT_EQ(own.wavelengths.size(), 2u);
    EXPECT_NEAR(own.wavelengths[0].meters, 540e-9, 1e-18);
    EXPECT_EQ(own.atmosphere.ground_albedo, (std::vector<double>{0.5, 0.6}));
    EXPECT_NEAR(own.atmosphere.layers[0].scattering[1].per_meter, 6e-3, 1e-15);
}

// A file carries a recipe of its packet alone.
TEST(Packets, AreAskedForByTheirNumber) {
    const auto bakes = [](const std::string& keys) {
        return "wavelengths = 'best 16'\n" + grey_air + keys;
    };
    const Recipe recipe = valid(bakes(matrix + "packet = 3\n"));
    ASSERT_EQ(names_of(recipe), Names{"transmittance"});
    EXPECT_EQ(packet_number(recipe.parameters.bakes[0]), 3);
}

// Lists of one value per wavelength are those of the whole recipe.
TEST(Packets, TakeTheirPartOfLists) {
    const std::string text =
        "wavelengths = '500 nm..550 nm by 10 nm'\n" + grey_air +
        "[bake.bruneton]\ntable = 'irradiance'\nsolar_irradiance = [1, 2, 3, 4, 5, 6]\n";
    const auto sun = [](const Bake& bake) { return bake.as<BrunetonBake>().solar_irradiance; };
    const Recipe recipe = valid(text);
    ASSERT_EQ(recipe.parameters.bakes.size(), 2u);
    EXPECT_EQ(sun(recipe.parameters.bakes[0]), (std::vector<double>{1, 2, 3, 4}));
    EXPECT_EQ(sun(recipe.parameters.bakes[1]), (std::vector<double>{5, 6}));
    EXPECT_EQ(sun(valid(text + "packet = 2\n").parameters.bakes[0]), (std::vector<double>{5, 6}));
}

}  // namespace
}  // namespace skybake::config
