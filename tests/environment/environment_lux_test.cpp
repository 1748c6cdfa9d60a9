// The illuminance that the lights of the preset "earth" tell, against published values of a level surface
// under the sun and a clear sky. Sun elevations are those of its unrefracted centre.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <string>

#include "tests/support/atmospheres.h"
#include "tests/support/shared_bakes.h"

namespace skybake::test {
namespace {

// The sum of all numbers that follow a name.
double sum_after(const std::string& text, const std::string& name) {
    double sum = 0;
    for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1)) {
        sum += std::strtod(text.c_str() + at + name.size(), nullptr);
    }
    return sum;
}

// The bakes of a test share the solved light.
class EnvironmentLux : public ::testing::Test {
  protected:
    double told_lux(double sun_degrees) {
        const config::Recipe recipe = recipe_of(
            "preset = \"earth\"\n[bake.around]\nasset = \"environment\"\nsize = [64, 32]\n"
            "lights = true\nsun_elevation = \"" +
            std::to_string(sun_degrees) + " deg\"\n");
        const Baked baked = bakes_.baked(recipe, recipe.parameters.bakes.front());
        return baked.companion
                   ? sum_after(baked.companion->text, "\"illuminance_of_level_surface_lux\": ")
                   : 0;
    }

  private:
    SharedBakes bakes_;
};

// Janiczek & DeYoung, "Computer Programs for Sun and Moon Illuminance", U.S. Naval Observatory Circular
// 171, 1987: log10 of lux is a polynomial of the sun's elevation over 90 degrees. They are means of clear
// skies of any haze.
double mean_of_clear_skies_lux(double sun_degrees) {
    const std::array<double, 4> c = sun_degrees < -5 ? std::array{2.70, 12.17, -431.69, -1899.83}
                                    : sun_degrees < -0.8 ? std::array{2.88, 21.81, -258.11, -858.36}
                                    : sun_degrees < 5    ? std::array{2.88, 22.26, -207.64, 1034.30}
                                                         : std::array{3.74, 3.97, -4.07, 1.47};
    const double x = sun_degrees / 90;
    return std::pow(10, c[0] + x * (c[1] + x * (c[2] + x * c[3])));
}

TEST_F(EnvironmentLux, IsThatOfTheMeanClearSky) {
    EXPECT_NEAR(mean_of_clear_skies_lux(60), 103e3, 1e3);  // as the circular's own program has it
    EXPECT_NEAR(told_lux(60) / mean_of_clear_skies_lux(60), 1, 0.1);
    for (const double sun_degrees : {-6., -4., -2., 0., 2.}) {
        EXPECT_NEAR(told_lux(sun_degrees) / mean_of_clear_skies_lux(sun_degrees), 1, 0.25)
            << sun_degrees;
    }
}

// For clear evenings the American Meteorological Society's Glossary of Meteorology has 410 to 585 lx at
// sunset, when the centre is at -50', and 2 to 3.5 lx at -6 degrees ("civil twilight"). Kishida 1989,
// "Changes in light intensity at twilight and estimation of the biological photoperiod" (Japan
// Agricultural Research Quarterly 22), states 430 to 670 lx at sunset of fine days.
TEST_F(EnvironmentLux, IsThatOfClearEvenings) {
    const double sunset = told_lux(-50. / 60);
    EXPECT_GT(sunset, 430);
    EXPECT_LT(sunset, 585);
    const double end_of_civil_twilight = told_lux(-6);
    EXPECT_GT(end_of_civil_twilight, 2);
    EXPECT_LT(end_of_civil_twilight, 3.5);
}

}  // namespace
}  // namespace skybake::test
