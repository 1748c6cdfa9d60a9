// The illuminance that the lights of a clear sky tell, against published values of a level surface under the
// sun and a clear sky: the polynomials of Janiczek & DeYoung, "Computer Programs for Sun and Moon
// Illuminance", U.S. Naval Observatory Circular 171, 1987. They are means of clear skies of any haze, to which
// single clear days differ by a factor of 2 or more in twilight.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <string>

#include "bakers/assets/registry.h"
#include "tests/support/atmospheres.h"

namespace skybake {
namespace {

// The sum of all numbers that follow a name.
double sum_after(const std::string& text, const std::string& name) {
    double sum = 0;
    for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1)) {
        sum += std::strtod(text.c_str() + at + name.size(), nullptr);
    }
    return sum;
}

// The illuminance of a level surface by sun and sky, as the lights of the preset "earth" tell it.
double told_lux(double sun_degrees) {
    const config::Recipe recipe = test::recipe_of(
        "preset = \"earth\"\n[bake.around]\nasset = \"environment\"\nsize = [64, 32]\nlights = "
        "true\n"
        "sun_elevation = \"" +
        std::to_string(sun_degrees) + " deg\"\n");
    const auto baked =
        bake_asset(recipe, recipe.parameters.bakes.front(), {2, Certification::off, nullptr});
    if (!baked.value || !baked.value->companion) return 0;
    return sum_after(baked.value->companion->text, "\"illuminance_of_level_surface_lux\": ");
}

// The published value: log10 of lux is a polynomial of the sun's elevation over 90 degrees.
double published_lux(double sun_degrees, const std::array<double, 4>& c) {
    const double x = sun_degrees / 90;
    return std::pow(10, c[0] + x * (c[1] + x * (c[2] + x * c[3])));
}

TEST(EnvironmentLux, IsThatOfClearSkies) {
    const double day = published_lux(60, {3.74, 3.97, -4.07, 1.47});
    EXPECT_NEAR(day, 103e3, 1e3);
    EXPECT_NEAR(told_lux(60) / day, 1, 0.1);
    const double sunset = published_lux(0, {2.88, 22.26, -207.64, 1034.30});
    EXPECT_NEAR(sunset, 759, 1);
    EXPECT_NEAR(told_lux(0) / sunset, 1.3, 0.2);
    const double civil_twilight = published_lux(-6, {2.70, 12.17, -431.69, -1899.83});
    EXPECT_NEAR(civil_twilight, 3.41, 0.02);
    EXPECT_NEAR(told_lux(-6) / civil_twilight, 1.9, 0.3);
}

}  // namespace
}  // namespace skybake
