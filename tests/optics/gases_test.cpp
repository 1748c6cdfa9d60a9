// Cross-sections and columns of gases, against published values.
#include "config/optics/gases.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/optics/columns.h"

namespace skybake::config {
namespace {

constexpr Length nanometers(double nm) { return {nm * 1e-9}; }

double zenith_depth(Gas gas, double nm) {
    return gas_optics(gas, nanometers(nm)).extinction_m2() * standard_column_per_m2(gas);
}

struct Known {
    double nm, value;
};

// Bucholtz 1995, by his formula in other programs.
TEST(Air, ScattersAsBucholtzPublished) {
    for (const Known known : {Known{680, 1.9030e-31}, {550, 4.5068e-31}, {440, 1.1280e-30}})
        EXPECT_NEAR(rayleigh_cross_section_m2(nanometers(known.nm)) / known.value, 1, 1e-4);
    // His table 1, in 1e-31 m^2.
    for (const Known known : {Known{400, 16.73}, {500, 6.661}, {600, 3.162}, {700, 1.692}})
        EXPECT_NEAR(rayleigh_cross_section_m2(nanometers(known.nm)) / (known.value * 1e-31), 1,
                    3e-3)
            << known.nm;
}

TEST(Air, HasNoStepWhereTwoFitsMeet) {
    const double below = rayleigh_cross_section_m2(nanometers(499.999));
    const double above = rayleigh_cross_section_m2(nanometers(500.001));
    EXPECT_NEAR(below / above, 1, 1.1e-3);
    for (double nm = 361; nm <= 830; ++nm)
        EXPECT_LT(rayleigh_cross_section_m2(nanometers(nm)),
                  rayleigh_cross_section_m2(nanometers(nm - 1)));
}

// Bodhaine et al. 1999 give 1.0484 to 1.0515 over the visible; Bucholtz tabulates a depolarisation
// of 0.02955 at 400, 0.02842 at 550, 0.02786 at 700 nm.
TEST(Air, IsDepolarizedAsBatesPublished) {
    for (const Known known : {Known{400, 0.02955}, {550, 0.02842}, {700, 0.02786}}) {
        EXPECT_NEAR(rayleigh_depolarization(nanometers(known.nm)), known.value, 2e-4) << known.nm;
        const double rho = rayleigh_depolarization(nanometers(known.nm));
        EXPECT_NEAR(king_factor(nanometers(known.nm)), (6 + 3 * rho) / (6 - 7 * rho), 1e-12);
    }
}

TEST(Air, HasThePublishedColumnAndDepths) {
    EXPECT_NEAR(air_column_per_m2() / 2.148e29, 1, 2e-4);
    EXPECT_DOUBLE_EQ(air_column_per_m2(50000), air_column_per_m2(100000) / 2);
    for (const Known known : {Known{680, 0.0409}, {550, 0.0968}, {440, 0.2423}})
        EXPECT_NEAR(zenith_depth(Gas::air, known.nm), known.value, 5e-5);
}

// The 233-K spectrum every 0.01 nm as CalcMySky has it, in 1e-25 m^2; of 300 DU these are depths of
// 0.01063, 0.02647 and 0.00107.
TEST(Ozone, HasThePublishedDepths) {
    for (const Known known : {Known{680, 1.318484}, {550, 3.284391}, {440, 0.1324839}}) {
        const double published = known.value * 1e-25 * 300 * kDobsonUnit_per_m2;
        EXPECT_NEAR(zenith_depth(Gas::ozone, known.nm) / published, 1, 1e-3) << known.nm;
    }
}

// Calculated by Sneep & Ubachs 2005 (table 3) at 532.2 nm, 1e-31 m^2.
TEST(OtherGases, ScatterAsPublished) {
    const auto at = [](Gas gas) { return gas_optics(gas, nanometers(532.2)).scattering_m2 * 1e31; };
    EXPECT_NEAR(at(Gas::nitrogen), 5.30, 0.02);
    EXPECT_NEAR(at(Gas::carbon_dioxide), 13.39, 0.1);
    // Their depolarisations (Bates 1984; Alms et al. 1975).
    EXPECT_NEAR(gas_optics(Gas::nitrogen, nanometers(532.2)).depolarization, 0.0205, 3e-4);
    EXPECT_NEAR(gas_optics(Gas::carbon_dioxide, nanometers(532.2)).depolarization, 0.079, 1e-3);
    // Four fifths of air are nitrogen.
    for (const double nm : {400.0, 467.0, 469.0, 550.0, 700.0}) {
        const double air = rayleigh_cross_section_m2(nanometers(nm));
        EXPECT_NEAR(gas_optics(Gas::nitrogen, nanometers(nm)).scattering_m2 / air, 1.026, 0.01)
            << nm;
    }
}

// Means over 10 nm of the spectrum at 233 K as E. Bruneton published them in 2017, 1e-25 m^2: 400
// nm to 770.
TEST(Ozone, HasThePublishedMeans) {
    constexpr std::array kMeans = {
        0.01527, 0.02763, 0.0552, 0.08451, 0.1582, 0.2316, 0.3669, 0.4924, 0.7752, 0.9016,
        1.48,    1.602,   2.139,  2.755,   3.091,  3.5,    4.266,  4.672,  4.398,  4.701,
        5.019,   4.305,   3.74,   3.215,   2.662,  2.238,  1.852,  1.473,  1.209,  0.9423,
        0.7455,  0.6566,  0.5105, 0.415,   0.4228, 0.3237, 0.2451, 0.2801};
    for (std::size_t i = 0; i < kMeans.size(); ++i) {
        const double from = 400 + 10 * static_cast<double>(i);
        double mean = 0;
        for (int k = 0; k < 100; ++k)
            mean += gas_optics(Gas::ozone, nanometers(from + 0.1 * k + 0.05)).absorption_m2 / 100;
        EXPECT_NEAR(mean / (kMeans[i] * 1e-25), 1, from < 450 ? 0.018 : 0.008) << from;
    }
}

TEST(Ozone, AbsorbsAlongALineInTemperature) {
    for (double nm = 362; nm <= 780; nm += 7) {
        const auto at = [nm](double kelvin) {
            return gas_optics(Gas::ozone, nanometers(nm), kelvin).absorption_m2;
        };
        EXPECT_NEAR(at(263), (at(233) + at(293)) / 2, 1e-9 * at(293));
        EXPECT_DOUBLE_EQ(at(293), at(350));
        EXPECT_GE(at(193), 0);
        EXPECT_LE(at(233), at(293) * 1.001) << nm;
    }
    // The Chappuis band's top hardly heeds temperature.
    const double cold = gas_optics(Gas::ozone, nanometers(602), 233).absorption_m2;
    const double warm = gas_optics(Gas::ozone, nanometers(602), 293).absorption_m2;
    EXPECT_NEAR(cold / warm, 1, 0.003);
    EXPECT_NEAR(warm, 5.15e-25, 0.02e-25);
}

TEST(Ozone, HasLoschmidtsDobsonUnit) {
    EXPECT_NEAR(kDobsonUnit_per_m2, 2.6867e20, 1e16);
    // 10 um at 273.15 K and 101325 Pa.
    EXPECT_NEAR(kDobsonUnit_per_m2, 1e-5 * 101325 / (1.380649e-23 * 273.15), 1e15);
}

// JPL 06-2; IUPAC's 300-K value at 400 nm is 6.4e-23 m^2. 3e19 molecules are a depth of 0.002.
TEST(NitrogenDioxide, AbsorbsBlue) {
    const auto at = [](double nm) {
        return gas_optics(Gas::nitrogen_dioxide, nanometers(nm)).absorption_m2;
    };
    EXPECT_NEAR(at(400), 6.44e-23, 1e-26);
    EXPECT_NEAR(at(550), 1.10e-23, 1e-26);
    EXPECT_NEAR(at(402.5), (6.44 + 5.82) / 2 * 1e-23, 1e-26);
    EXPECT_EQ(at(700), 0);
    EXPECT_NEAR(zenith_depth(Gas::nitrogen_dioxide, 400), 0.00193, 1e-5);
    // No entry is a misprint by a power of ten.
    for (double nm = 365; nm <= 655; nm += 5) {
        EXPECT_GT(at(nm), 0.35 * at(nm + 5)) << nm;
        EXPECT_LT(at(nm), 3 * at(nm + 5)) << nm;
    }
}

// Bands only, and in the zenith the mean depths of Bird & Riordan 1986 within a third: 0.057 over
// 10 nm around 690, 0.353 around 762.5 nm.
TEST(Oxygen, AbsorbsInItsBands) {
    for (const double nm : {400.0, 500.0, 600.0, 660.0, 740.0, 800.0})
        EXPECT_EQ(zenith_depth(Gas::oxygen, nm), 0) << nm;
    EXPECT_NEAR(standard_column_per_m2(Gas::oxygen), 4.5e28, 0.01e28);
    double b_band = 0, a_band = 0;
    for (int i = 0; i < 100; ++i) {
        b_band += std::exp(-zenith_depth(Gas::oxygen, 685 + 0.1 * i)) / 100;
        a_band += std::exp(-zenith_depth(Gas::oxygen, 757.5 + 0.1 * i)) / 100;
    }
    EXPECT_NEAR(-std::log(b_band), 0.057, 0.02);
    EXPECT_NEAR(-std::log(a_band), 0.353, 0.05);
    EXPECT_NEAR(zenith_depth(Gas::oxygen, 630), 0.014, 0.002);
}

TEST(WaterVapor, AbsorbsInItsBands) {
    for (const double nm : {400.0, 500.0, 550.0, 640.0, 765.0})
        EXPECT_LT(zenith_depth(Gas::water_vapor, nm), 1e-4) << nm;
    EXPECT_NEAR(zenith_depth(Gas::water_vapor, 724.4), 0.123, 0.001);
    EXPECT_NEAR(zenith_depth(Gas::water_vapor, 593), 0.0152, 1e-4);
}

// Messages print the ends of a range.
TEST(Gases, RangesEndAtWholeNanometres) { EXPECT_EQ(range_of(Gas::ozone).shortest.meters, 360e-9); }

TEST(Gases, AreKnownOverTheVisible) {
    for (int number = 0; number <= static_cast<int>(Gas::carbon_dioxide); ++number) {
        const auto gas = static_cast<Gas>(number);
        const WavelengthRange range = range_of(gas);
        EXPECT_TRUE(range.contains(nanometers(380)));
        EXPECT_TRUE(range.contains(nanometers(780)));
        EXPECT_GT(standard_column_per_m2(gas), 0);
        for (double nm = 380; nm <= 780; nm += 0.5) {
            const GasOptics optics = gas_optics(gas, nanometers(nm));
            EXPECT_GE(optics.absorption_m2, 0);
            EXPECT_EQ(optics.scattering_m2 > 0, scatters(gas));
            EXPECT_LT(zenith_depth(gas, nm), 0.5);
        }
    }
}

}  // namespace
}  // namespace skybake::config
