// `wavelengths`, [color], and which assets can hold them.
#include "config/fields/wavelength_reader.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "config/sections/color.h"
#include "tests/config/recipes.h"

namespace skybake::config {
namespace {

using testing::codes_and_places;
using testing::parse;
using testing::valid;
using Codes = std::vector<std::string>;

const std::string grey_air =
    "[atmosphere]\nground_radius = '6360 km'\ntop_radius = '6420 km'\n"
    "[atmosphere.layers.air]\nprofile = 'exponential'\nscale_height = '8 km'\n"
    "scattering = '1e-5 /m'\n";

Codes faults(const std::string& text) { return codes_and_places(parse(text).diagnostics); }

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
    EXPECT_EQ(nm_of("'best 4'"), nm_of("['445 nm', '523 nm', '571 nm', '636 nm']"));
    EXPECT_EQ(faults("wavelengths = 'best 5'\n" + grey_air), Codes{"E0104 1:15"});
}

TEST(Wavelengths, RangesHaveBothEnds) {
    const std::vector<double> nm = nm_of("'380 nm..780 nm by 5 nm'");
    ASSERT_EQ(nm.size(), 81u);
    EXPECT_DOUBLE_EQ(nm.front(), 380);
    EXPECT_NEAR(nm[1], 385, 1e-9);
    EXPECT_NEAR(nm.back(), 780, 1e-9);
    EXPECT_EQ(nm_of("'0.4 um..450 nm by 20 nm'").size(), 3u);
    for (const std::string wrong :
         {"'780 nm..380 nm by 5 nm'", "'380 nm..780 nm'", "'380 nm..780 nm by 0 nm'",
          "'380 nm..780 nm by -5 nm'", "'380 nm..780 nm by 5'", "'380 nm..780 nm by 0.1 nm'"}) {
        EXPECT_EQ(faults("wavelengths = " + wrong + "\n" + grey_air).size(), 1u) << wrong;
    }
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

TEST(Color, AssetsHoldTheWavelengthsThatTheyCan) {
    const std::string sky = "[bake.sky_view]\nsun_elevations = ['30 deg']\n";
    const std::string matrix = "[bake.transmittance]\n";
    const std::string mean = "[bake.multiple_scattering]\nmethod = 'solved'\n";
    EXPECT_EQ(faults("wavelengths = 'best 16'\n" + grey_air + sky), Codes{});
    EXPECT_EQ(faults("wavelengths = 'best 4'\n" + grey_air + sky + matrix + mean), Codes{});
    EXPECT_EQ(faults("wavelengths = 'best 8'\n" + grey_air +
                     "[bake.aerial_perspective]\naltitude = '1 km'\nsun_elevation = '9 deg'\n"),
              Codes{});
    EXPECT_EQ(faults("wavelengths = 'best 8'\n" + grey_air + matrix), Codes{"E0147 1:15"});
    EXPECT_EQ(faults("wavelengths = ['500 nm', '900 nm']\n" + grey_air + sky + "[color]\n"),
              Codes{"E0147 1:15"});
    EXPECT_EQ(faults("wavelengths = ['500 nm', '600 nm']\n" + grey_air + sky), Codes{"E0147 1:15"});
    EXPECT_EQ(faults("wavelengths = ['500 nm']\n" + grey_air + sky + "[color]\n"),
              Codes{"E0147 1:15"});
    EXPECT_EQ(faults("wavelengths = 'best 4'\n" + grey_air + "[color]\nspace = 'none'\n" + sky),
              Codes{"E0147 1:15"});
    EXPECT_EQ(faults("wavelengths = 'best 4'\n" + grey_air + mean + "content = 'moments'\n"),
              Codes{});
    const std::string bruneton = "[bake.bruneton]\ntable = 'scattering'\n";
    EXPECT_EQ(faults("wavelengths = 'best 4'\n" + grey_air + bruneton), Codes{});
    EXPECT_EQ(
        faults("wavelengths = 'best 4'\n" + grey_air + "[color]\nspace = 'none'\n" + bruneton),
        Codes{"E0147 1:15"});
}

}  // namespace
}  // namespace skybake::config
