// Condensation against a bisection in double precision.
#include "bakers/convection/saturation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bakers/convection/moist_air.h"

namespace skybake::convection {
namespace {

// Bolton's formula, with the C library's exponential.
double saturated(double temperature_k, double pressure_pa) {
    const double vapour =
        611.2 * std::exp(17.67 * (temperature_k - 273.15) / (temperature_k - 29.65));
    return 622 * vapour / (pressure_pa - 0.378 * vapour);
}

// More water than the root leaves the air below saturation, and less above it.
double bisected(double heat, double water, double pressure_pa) {
    const double exner = std::pow(pressure_pa / 1e5, 287.04 / 1004);
    double low = -60, high = 60;
    for (int i = 0; i < 100; ++i) {
        const double root = 0.5 * (low + high);
        const double temperature = (heat + 2.5e6 / 1004 * 1e-3 * root / exner) * exner;
        (water - root > saturated(temperature, pressure_pa) ? low : high) = root;
    }
    return low;
}

TEST(Saturation, EqualsABisection) {
    int clouds = 0;
    for (const double pressure : {101325.0, 90000.0, 70000.0, 40000.0}) {
        for (double heat = 280; heat <= 330; heat += 2.5) {
            for (double water = 0; water <= 25; water += 1.25) {
                Level level;
                level.pressure_pa = static_cast<float>(pressure);
                level.exner = static_cast<float>(std::pow(pressure / 1e5, kGasOverHeat));
                const auto stored = static_cast<float>(heat - kReference);
                const auto grams = static_cast<float>(water);
                const double expected = bisected(heat, water, pressure);
                if (std::abs(expected) > 8)
                    continue;  // no cloud has more, and no edge is near less
                float root = 0;
                condensed({&stored, &grams, 1}, level, &root);
                ASSERT_NEAR(double{root}, expected, 2e-4)
                    << pressure << " " << heat << " " << water;
                clouds += root > 0 ? 1 : 0;
            }
        }
    }
    EXPECT_GT(clouds, 100);
}

// Droplets weigh, vapour lifts, and the heat of condensation lifts more.
TEST(Saturation, BuoyancyIsThatOfTheVirtualPotentialTemperature) {
    const Level level{90000, static_cast<float>(std::pow(0.9, kGasOverHeat)), -10, 5, {}};
    const float own = virtual_heat(level);
    for (const double water : {5.0, 10.0, 14.0}) {
        const float heat = -9;
        const auto grams = static_cast<float>(water);
        float found = 0;
        buoyancies({&heat, &grams, 1}, level, own, &found);
        const double liquid = std::max(0.0, bisected(291, water, 90000));
        const double warm = 291 + 2.5e6 / 1004 * 1e-3 * liquid / std::pow(0.9, kGasOverHeat);
        const double lifted = warm * (1 + 1e-3 * (0.608 * (water - liquid) - liquid));
        const double still = 290 * (1 + 1e-3 * 0.608 * 5);
        EXPECT_NEAR(double{found}, 9.81 / 300 * (lifted - still), 1e-5) << water;
    }
}

}  // namespace
}  // namespace skybake::convection
