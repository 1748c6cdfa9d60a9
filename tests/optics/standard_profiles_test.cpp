// Profiles of gases, against the US Standard Atmosphere 1976 as its definition computes it and
// against rows of AFGL-TR-86-0110.
#include "config/optics/standard_profiles.h"
#include "config/sections/layer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "tests/optics/columns.h"

namespace skybake::config {
namespace {

// The density relative to the ground: layers of geopotential height, each with its lapse rate, to
// 86 km.
double standard_density(double altitude_m) {
    struct Layer {
        double bottom_m, lapse_K_per_m;
    };
    constexpr Layer kLayers[] = {{0, -0.0065}, {11000, 0},       {20000, 0.001},  {32000, 0.0028},
                                 {47000, 0},   {51000, -0.0028}, {71000, -0.002}, {84852, 0}};
    constexpr double kRadius_m = 6356766, kHydrostatic_K_per_m = 9.80665 * 28.9644 / 8314.32;
    const double height = kRadius_m * altitude_m / (kRadius_m + altitude_m);
    double temperature = 288.15, pressure = 1;
    for (std::size_t i = 0; i + 1 < std::size(kLayers) && height > kLayers[i].bottom_m; ++i) {
        const double rise = std::min(height, kLayers[i + 1].bottom_m) - kLayers[i].bottom_m;
        const double lapse = kLayers[i].lapse_K_per_m, top = temperature + lapse * rise;
        pressure *= lapse == 0 ? std::exp(-kHydrostatic_K_per_m * rise / temperature)
                               : std::pow(temperature / top, kHydrostatic_K_per_m / lapse);
        temperature = top;
    }
    return pressure * 288.15 / temperature;
}

// US Standard Atmosphere 1976, table I: density over that of the ground. 11019 m are 11 km of
// geopotential height.
TEST(StandardAtmosphere, IsThatOfItsTable) {
    EXPECT_NEAR(standard_density(11019), 0.29708, 2e-5);
    EXPECT_NEAR(standard_density(20000), 0.07258, 2e-5);
    EXPECT_NEAR(standard_density(50000), 8.3827e-4, 1e-7);
    EXPECT_NEAR(standard_density(80000), 1.5068e-5, 5e-9);
}

TEST(AirProfile, HoldsTheStandardAtmosphere) {
    const auto profile = standard_profile(Gas::air);
    for (double altitude = 0; altitude <= 86000; altitude += 50) {
        const double exact = standard_density(altitude);
        const double bound = (altitude < 45000 ? 0.01 : 0.03) * exact + 2e-7;
        EXPECT_NEAR(profile_at(profile, altitude), exact, bound) << altitude;
    }
}

TEST(AirProfile, HoldsItsColumn) {
    double exact_m = 0;
    constexpr double kStep_m = 10;
    for (double altitude = kStep_m / 2; altitude < 86000; altitude += kStep_m)
        exact_m += standard_density(altitude) * kStep_m;
    EXPECT_NEAR(profile_depth_m(standard_profile(Gas::air)) / exact_m, 1, 0.003);
    // With the density of the ground, 2.5470e25 per m^3, that is the column of gases.h with mean
    // gravity.
    EXPECT_NEAR(exact_m * 2.5470e25 / air_column_per_m2(101325, 9.790), 1, 1e-3);
}

struct Level {
    double altitude_km, density;
};

void expect_levels(Gas gas, std::span<const Level> levels, double greatest, double relative,
                   double absolute) {
    for (const Level& level : levels) {
        const double exact = level.density / greatest;
        EXPECT_NEAR(profile_at(standard_profile(gas), level.altitude_km * 1000), exact,
                    relative * exact + absolute)
            << level.altitude_km;
    }
}

// AFGL-TR-86-0110, US standard, per cm^3, in a copy that holds densities: fitted were mixing
// ratios.
TEST(OzoneProfile, HoldsAfgl) {
    constexpr Level kLevels[] = {
        {0, 6.7777e11},   {2, 6.7783e11},  {4, 5.7714e11},  {6, 5.6458e11},    {8, 6.5268e11},
        {10, 1.12944e12}, {12, 2.0083e12}, {14, 2.3837e12}, {16, 3.0123e12},   {18, 4.0151e12},
        {20, 4.7686e12},  {22, 4.8943e12}, {24, 4.5183e12}, {27.5, 3.2729e12}, {30, 2.5098e12}};
    expect_levels(Gas::ozone, kLevels, 4.8943e12, 0.012, 0.0035);
    EXPECT_NEAR(profile_depth_m(standard_profile(Gas::ozone)) * 4.8943e18 / kDobsonUnit_per_m2, 345,
                2);
}

// AFGL-TR-86-0110, US standard: mixing ratios in parts per million, linear between its levels.
double afgl_ozone(double altitude_km) {
    constexpr double kLevels[][2] = {
        {0, 0.0266},  {1, 0.02931}, {2, 0.03237},  {3, 0.03318}, {4, 0.03387},  {5, 0.03768},
        {6, 0.04112}, {7, 0.05009}, {8, 0.05966},  {9, 0.09168}, {10, 0.1313},  {11, 0.2149},
        {12, 0.3095}, {13, 0.3846}, {14, 0.503},   {15, 0.6505}, {16, 0.8701},  {17, 1.187},
        {18, 1.587},  {19, 2.03},   {20, 2.579},   {21, 3.028},  {22, 3.647},   {23, 4.168},
        {24, 4.627},  {25, 5.118},  {27.5, 5.803}, {30, 6.553},  {32.5, 7.373}, {35, 7.837},
        {37.5, 7.8},  {40, 7.3},    {42.5, 6.2},   {45, 5.25},   {47.5, 4.1},   {50, 3.1},
        {55, 1.8},    {60, 1.1},    {65, 0.7},     {70, 0.3},    {75, 0.25}};
    std::size_t i = 1;
    while (i + 1 < std::size(kLevels) && kLevels[i][0] < altitude_km) ++i;
    const auto [low_km, low] = kLevels[i - 1];
    const auto [high_km, high] = kLevels[i];
    const double ppm = low + (high - low) * (altitude_km - low_km) / (high_km - low_km);
    return ppm * 1e-6 * standard_density(altitude_km * 1000) * 2.5470e25;
}

TEST(OzoneProfile, HoldsAfglBetweenItsLevels) {
    for (double altitude_km = 0; altitude_km <= 75; altitude_km += 0.125) {
        const double exact = afgl_ozone(altitude_km) / 4.91e18;
        EXPECT_NEAR(profile_at(standard_profile(Gas::ozone), altitude_km * 1000), exact,
                    0.01 * exact + 0.003)
            << altitude_km;
    }
}

// Each altitude costs solvers once, not twice.
TEST(OzoneProfile, HasTheAltitudesOfAir) {
    const auto air = standard_profile(Gas::air);
    const auto ozone = standard_profile(Gas::ozone);
    ASSERT_LE(ozone.size(), air.size());
    for (std::size_t i = 0; i < ozone.size(); ++i) {
        EXPECT_EQ(ozone[i].altitude_m, air[i].altitude_m);
    }
}

TEST(WaterVaporProfile, HoldsAfgl) {
    constexpr Level kLevels[] = {{0, 1.97343e17}, {1, 1.40422e17},  {2, 9.69732e16},
                                 {3, 6.01716e16}, {4, 3.67723e16},  {5, 2.14020e16},
                                 {6, 1.27057e16}, {7, 7.02416e15},  {8, 4.01170e15},
                                 {9, 1.53852e15}, {10, 6.01796e14}, {12, 1.23680e14}};
    expect_levels(Gas::water_vapor, kLevels, 1.97343e17, 0.011, 0.0022);
    const double column = profile_depth_m(standard_profile(Gas::water_vapor)) * 1.97343e23;
    EXPECT_NEAR(column / kStandardWaterVapor_per_m2, 1, 0.01);
}

TEST(NitrogenDioxideProfile, HoldsAfgl) {
    constexpr Level kLevels[] = {
        {0, 5.8604e8},    {4, 3.9192e8},   {8, 2.5162e8},     {11, 1.98832e8},  {14, 3.54477e8},
        {16, 1.104378e9}, {18, 1.95063e9}, {20, 2.57011e9},   {25, 3.118038e9}, {30, 2.35928e9},
        {35, 1.282008e9}, {40, 3.34893e8}, {42.5, 1.259251e8}};
    expect_levels(Gas::nitrogen_dioxide, kLevels, 3.118038e9, 0.0101, 0.0051);
}

TEST(Profiles, AscendAndEndAtZero) {
    for (int gas = 0; gas <= static_cast<int>(Gas::carbon_dioxide); ++gas) {
        const auto profile = standard_profile(static_cast<Gas>(gas));
        EXPECT_GE(profile.size(), 10u);
        EXPECT_LE(profile.size(), 31u);
        EXPECT_EQ(profile.front().altitude_m, 0);
        EXPECT_EQ(profile.back().relative_density, 0);
        EXPECT_EQ(profile_at(profile, profile.back().altitude_m + 1), 0);
        for (std::size_t i = 0; i < profile.size(); ++i) {
            EXPECT_GE(profile[i].relative_density, 0);
            EXPECT_LE(profile[i].relative_density, 1);
            if (i > 0) {
                EXPECT_GT(profile[i].altitude_m, profile[i - 1].altitude_m);
            }
        }
    }
}

TEST(Profiles, IntegrateTheirBrokenLine) {
    constexpr std::array kTent = {ProfilePoint{0, 0}, ProfilePoint{1000, 1}, ProfilePoint{3000, 0}};
    EXPECT_DOUBLE_EQ(profile_depth_m(kTent), 1500);
    EXPECT_DOUBLE_EQ(profile_at(kTent, 2000), 0.5);
}

}  // namespace
}  // namespace skybake::config
