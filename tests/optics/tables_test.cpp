#include <gtest/gtest.h>

#include <cmath>

#include "config/optics/aerosol_components.h"
#include "config/optics/elementary.h"
#include "config/optics/gases.h"

namespace skybake::config {
namespace {

TEST(Elementary, FunctionsAreThoseOfTheLibraryToFifteenDigits) {
    for (double x = 1e-9; x < 1e9; x *= 1.37) {
        EXPECT_NEAR(logarithm(x), std::log(x), 1e-15 * std::fmax(std::fabs(std::log(x)), 1e-3))
            << x;
    }
    for (double x = -60; x < 60; x += 0.173) {
        EXPECT_NEAR(exponential(x) / std::exp(x), 1, 2e-15) << x;
    }
    for (double x = 1e-12; x < 60; x *= 1.37) {
        EXPECT_NEAR(exponential_less_one(x) / std::expm1(x), 1, 2e-15) << x;
        EXPECT_NEAR(exponential_less_one(-x) / std::expm1(-x), 1, 2e-15) << x;
    }
    EXPECT_EQ(exponential_less_one(-1e300), -1);
    for (double base = 0.3; base < 3; base += 0.09) {
        for (double exponent = -5; exponent < 5; exponent += 0.31) {
            EXPECT_NEAR(power(base, exponent) / std::pow(base, exponent), 1, 5e-15)
                << base << ' ' << exponent;
        }
    }
    EXPECT_EQ(power(1, 3.7), 1);
    EXPECT_EQ(exponential(0), 1);
}

// The tables were compared with their sources when they were typed in. So that no digit changes
// unseen after that, the sum of the logarithms of all their values is held here.

constexpr Length nanometers(double nm) { return {nm * 1e-9}; }

double absorption_logarithms(Gas gas, double from_nm, double to_nm, double step_nm,
                             double temperature_K = kOzoneLayerTemperature_K) {
    double sum = 0;
    for (double nm = from_nm; nm <= to_nm; nm += step_nm)
        sum += std::log(gas_optics(gas, nanometers(nm), temperature_K).absorption_m2);
    return sum;
}

TEST(TypedTables, OfGases) {
    EXPECT_NEAR(absorption_logarithms(Gas::ozone, 360, 780, 1, 233), -24509.949, 0.01);
    EXPECT_NEAR(absorption_logarithms(Gas::ozone, 360, 780, 1, 293), -24465.832, 0.01);
    EXPECT_NEAR(absorption_logarithms(Gas::nitrogen_dioxide, 360, 660, 5), -3209.409, 0.005);
    EXPECT_NEAR(absorption_logarithms(Gas::oxygen, 685, 695, 5), -208.420, 0.005);
    EXPECT_NEAR(absorption_logarithms(Gas::oxygen, 760, 775, 5), -277.268, 0.005);
    EXPECT_NEAR(absorption_logarithms(Gas::water_vapor, 670, 755, 5), -1195.233, 0.005);
}

TEST(TypedTables, OfParticles) {
    double real = 0, imaginary = 0, radii = 0, numbers = 0;
    for (const AerosolComponent component : all_aerosol_components()) {
        for (double nm = 350; nm <= 900; nm += 50) {
            const RefractiveIndex index = refractive_index_of(component, nanometers(nm), 0);
            real += std::log(index.real);
            imaginary += std::log(index.imaginary);
        }
        for (const double humidity : {0, 50, 70, 80, 90, 95, 98, 99})
            radii += std::log(radii_of(component, humidity).mode_radius.meters);
        const LogNormalRadii dry = radii_of(component, 0);
        radii += std::log(dry.smallest.meters) + std::log(dry.largest.meters) + dry.deviation;
    }
    double water = 0;
    for (double nm = 350; nm <= 900; nm += 50)
        water += std::log(water_index(nanometers(nm)).real) +
                 std::log(water_index(nanometers(nm)).imaginary);
    for (int mixture = 0; mixture <= static_cast<int>(AerosolMixture::antarctic); ++mixture)
        for (const MixturePart& part : parts_of(static_cast<AerosolMixture>(mixture)))
            numbers += std::log(part.particles.per_cubic_meter);
    EXPECT_NEAR(real, 51.20780, 1e-4);
    EXPECT_NEAR(imaginary, -951.5898, 1e-3);
    EXPECT_NEAR(radii, -1490.1792, 1e-3);
    EXPECT_NEAR(water, -211.5607, 1e-3);
    EXPECT_NEAR(numbers, 549.5929, 1e-3);
}

}  // namespace
}  // namespace skybake::config
