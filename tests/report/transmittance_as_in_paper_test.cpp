#include "bakers/assets/transmittance/transmittance_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "bakers/air/optical_depth.h"
#include "config/recipe/recipe.h"

namespace skybake {
namespace {

Medium medium_of(const std::string& text) {
    const auto recipe = config::parse_recipe(text, "recipe");
    EXPECT_TRUE(recipe.value);
    return recipe.value ? make_medium(recipe.value->parameters.atmosphere) : Medium{};
}

// One exponential layer: no kinks, which would hide the order.
Medium smooth_medium() {
    return medium_of(
        "preset = \"earth_hillaire\"\n"
        "[atmosphere.layers.mie]\nenabled = false\n"
        "[atmosphere.layers.ozone]\nenabled = false\n");
}

// s = r mu of a ray from the ground.
double s_of(const Medium& medium, double zenith_degrees) {
    return medium.ground_radius_km * std::cos(zenith_degrees * std::numbers::pi / 180);
}

double relative_error(const Medium& medium, double zenith_degrees, int steps, StepRule rule) {
    const double s = s_of(medium, zenith_degrees);
    const double exact = optical_depth_to_top(medium, 0, s)[0];
    return optical_depth_by_steps(medium, 0, s, steps, rule)[0] / exact - 1;
}

// log2 of the ratio of errors when steps are doubled.
double order(StepRule rule) {
    const Medium medium = smooth_medium();
    return std::log2(relative_error(medium, 60, 2000, rule) /
                     relative_error(medium, 60, 4000, rule));
}

TEST(TransmittanceAsInPaper, EndPointRuleIsOfFirstOrder) {
    EXPECT_NEAR(order(StepRule::end_point), 1, 0.02);
}

TEST(TransmittanceAsInPaper, MidpointRuleIsOfSecondOrder) {
    EXPECT_NEAR(order(StepRule::midpoint), 2, 0.02);
}

TEST(TransmittanceAsInPaper, TrapezoidRuleIsOfSecondOrder) {
    EXPECT_NEAR(order(StepRule::trapezoid), 2, 0.02);
}

TEST(TransmittanceAsInPaper, AllRulesConvergeToTheKernel) {
    const Medium medium = medium_of("preset = \"earth_hillaire\"\n");
    for (const double zenith : {0.0, 75.0, 90.0}) {
        EXPECT_NEAR(relative_error(medium, zenith, 200000, StepRule::end_point), 0, 1e-3);
        EXPECT_NEAR(relative_error(medium, zenith, 20000, StepRule::midpoint), 0, 1e-6);
        EXPECT_NEAR(relative_error(medium, zenith, 20000, StepRule::trapezoid), 0, 1e-6);
    }
}

// The failing that everyone copied: at 85 degrees blue light comes through about 30 % too bright.
TEST(TransmittanceAsInPaper, EndPointsLetTooMuchLightThrough) {
    const Medium medium = medium_of("preset = \"earth_hillaire\"\n");
    const double s = s_of(medium, 85);
    const double exact = std::exp(-optical_depth_to_top(medium, 0, s)[2]);
    const auto transmittance = [&](int steps, StepRule rule) {
        return std::exp(-optical_depth_by_steps(medium, 0, s, steps, rule)[2]);
    };
    EXPECT_NEAR(exact, 0.0636282952019, 1e-9);  // tests/data/exact_transmittance_setH.csv
    EXPECT_NEAR(transmittance(40, StepRule::end_point) / exact, 1.3, 0.06);
    EXPECT_NEAR(transmittance(40, StepRule::midpoint) / exact, 1, 0.01);
    EXPECT_NEAR(transmittance(500, StepRule::trapezoid) / exact, 1, 2e-4);
}

TEST(TransmittanceAsInPaper, AnEmptyMediumHasNoDepth) {
    const Medium medium = medium_of("preset = \"vacuum\"\n");
    for (const StepRule rule : {StepRule::end_point, StepRule::midpoint, StepRule::trapezoid}) {
        EXPECT_EQ(optical_depth_by_steps(medium, 0, s_of(medium, 30), 40, rule), Spectrum{});
    }
}

// At the top, straight up, the ray has no length.
TEST(TransmittanceAsInPaper, ARayWithoutLengthHasNoDepth) {
    const Medium medium = medium_of("preset = \"earth_hillaire\"\n");
    const double top = medium.thickness_km;
    for (const StepRule rule : {StepRule::end_point, StepRule::midpoint, StepRule::trapezoid}) {
        EXPECT_EQ(optical_depth_by_steps(medium, top, medium.top_radius_km(), 1, rule), Spectrum{});
    }
}

}  // namespace
}  // namespace skybake
