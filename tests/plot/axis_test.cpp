#include "bakers/plot/axis.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/plot/axes.h"

namespace skybake {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::vector<std::string> labels(const std::vector<AxisTick>& ticks) {
    std::vector<std::string> words;
    for (const AxisTick& tick : ticks) words.push_back(tick.label);
    return words;
}
using Words = std::vector<std::string>;

// --- Ticks --------------------------------------------------------------------------------------

TEST(AxisTicks, StandAtRoundNumbers) {
    EXPECT_EQ(labels(axis_ticks(axis(0, 100), 0.15)), (Words{"0", "20", "40", "60", "80", "100"}));
    EXPECT_EQ(labels(axis_ticks(axis(0.13, -0.31), 0.1)),
              (Words{"0.1", "0.05", "0", "−0.05", "−0.1", "−0.15", "−0.2", "−0.25", "−0.3"}));
    EXPECT_EQ(labels(axis_ticks(axis(0, 180, 1, AxisTicks::angles), 0.1)),
              (Words{"0", "30", "60", "90", "120", "150", "180"}));
    const ChartAxis decades{"", [](double t) { return std::pow(10.0, 3 * t - 5); },
                            AxisTicks::logarithmic};
    EXPECT_EQ(labels(axis_ticks(decades, 0.2)), (Words{"10⁻⁵", "10⁻⁴", "0.001", "0.01"}));
}

TEST(AxisTicks, AreFinerWhereTheAxisIsStretched) {
    // Altitude by its root: kilometres near the ground, tens of them above.
    const std::vector<AxisTick> ticks = axis_ticks(axis(0, 100, 2), 0.07);
    const Words words = labels(ticks);
    EXPECT_NE(std::find(words.begin(), words.end(), "2"), words.end());
    EXPECT_EQ(std::find(words.begin(), words.end(), "99"), words.end());
}

TEST(AxisTicks, LieWhereTheAxisHasTheirValueAndKeepTheirDistance) {
    EXPECT_TRUE(rc::check([] {
        const double first = *rc::gen::inRange(-1000, 1000) / 7.0;
        const double last = *rc::gen::suchThat(
            rc::gen::map(rc::gen::inRange(-1000, 1000), [](int n) { return n / 3.0; }),
            [&](double value) { return std::abs(value - first) > 1e-6; });
        const double power = *rc::gen::inRange(2, 60) / 10.0;
        const double gap = *rc::gen::inRange(2, 50) / 100.0;
        const auto kind = *rc::gen::element(AxisTicks::decimal, AxisTicks::angles);
        const ChartAxis chosen = axis(first, last, power, kind);
        const std::vector<AxisTick> ticks = axis_ticks(chosen, gap);
        double previous = -1;
        for (const AxisTick& tick : ticks) {
            RC_ASSERT(tick.t >= 0 && tick.t <= 1);
            RC_ASSERT(previous < 0 || tick.t - previous >= gap);
            // The value lies between those a billionth of the axis to both sides, but for rounding.
            const double before = chosen.value(std::max(tick.t - 1e-9, 0.0));
            const double after = chosen.value(std::min(tick.t + 1e-9, 1.0));
            const double rounding = 1e-8 * std::abs(last - first);
            RC_ASSERT(tick.value >= std::min(before, after) - rounding);
            RC_ASSERT(tick.value <= std::max(before, after) + rounding);
            previous = tick.t;
        }
        // With so much room there is always a round number.
        RC_ASSERT(gap > 0.1 || !ticks.empty());
    }));
}

TEST(AxisTicks, AreNotThereWithoutARange) {
    EXPECT_TRUE(axis_ticks(axis(3, 3), 0.1).empty());
    EXPECT_TRUE(axis_ticks(axis(0, nan), 0.1).empty());
    EXPECT_TRUE(axis_ticks(axis(0, INFINITY), 0.1).empty());
    const ChartAxis from_zero{"", [](double t) { return t; }, AxisTicks::logarithmic};
    EXPECT_FALSE(axis_ticks(from_zero, 0.1).empty()) << "no logarithms, but numbers";
}

TEST(NumberLabel, IsShort) {
    EXPECT_EQ(number_label(0), "0");
    EXPECT_EQ(number_label(-0.0), "0");
    EXPECT_EQ(number_label(-2.5), "−2.5");
    EXPECT_EQ(number_label(0.1 + 0.2), "0.3");
    EXPECT_EQ(number_label(2.5e-5), "2.5×10⁻⁵");
    EXPECT_EQ(number_label(1e10), "10¹⁰");
    EXPECT_EQ(number_label(-3e20), "−3×10²⁰");
}

TEST(MinorTicks, StandAtTheMultiplesOfPowersOfTen) {
    const ChartAxis decades = logarithmic_axis("", 1, 1000);
    const std::vector<double> places = minor_ticks(decades, 0.01);
    ASSERT_EQ(places.size(), 24u);
    EXPECT_NEAR(places[0], std::log10(2) / 3, 1e-12);
    EXPECT_NEAR(places[23], std::log10(900) / 3, 1e-12);
    EXPECT_TRUE(minor_ticks(decades, 0.02).empty()) << "9 and 10 are 0.015 apart";
    EXPECT_TRUE(minor_ticks(linear_axis("", 1, 1000), 0.001).empty());
}

// --- Ranges -------------------------------------------------------------------------------------

TEST(PlaceOn, IsWhereTheAxisHasTheValue) {
    const ChartAxis linear = linear_axis("", -1, 3), falling = linear_axis("", 3, -1);
    const ChartAxis decades = logarithmic_axis("", 0.01, 100);
    EXPECT_NEAR(place_on(linear, 0), 0.25, 1e-12);
    EXPECT_NEAR(place_on(falling, 0), 0.75, 1e-12);
    EXPECT_NEAR(place_on(decades, 1), 0.5, 1e-12);
    for (const double low : {0.0, -5.0, -infinity}) EXPECT_NEAR(place_on(decades, low), 0, 1e-12);
    for (const double high : {1e9, infinity, nan}) EXPECT_NEAR(place_on(decades, high), 1, 1e-12);
}

TEST(AxisOver, HoldsTheValuesThatCanBeShown) {
    const ChartAxis linear = axis_over("", {3, nan, -1, infinity, 1e200}, false, 0);
    EXPECT_EQ(linear.value(0), -1);
    EXPECT_EQ(linear.value(1), 3);
    const ChartAxis roomy = axis_over("", {0, 10}, false, 0.04);
    EXPECT_EQ(roomy.value(0), 0) << "0 stays at the frame";
    EXPECT_NEAR(roomy.value(1), 10.4, 1e-12);
    const ChartAxis decades = axis_over("", {-1, 0, 1e-20, 1, 100}, true, 0);
    EXPECT_NEAR(decades.value(0), 1e-10, 1e-22);
    EXPECT_NEAR(decades.value(1), 100, 1e-9);
    EXPECT_FALSE(can_show(decades, 0));
    EXPECT_TRUE(can_show(linear, 0));
    EXPECT_FALSE(can_show(linear, nan));
    EXPECT_FALSE(can_show(linear, infinity));
}

TEST(RoundedAxis, EndsAtRoundFiguresBeyondItsValues) {
    const ChartAxis rounded = rounded_axis("", {0.22, 90}, 1e-17);
    EXPECT_NEAR(rounded.value(0), 0.1, 1e-12) << "0.2 is too near";
    EXPECT_NEAR(rounded.value(1), 200, 1e-9) << "100 is too near";
    EXPECT_FALSE(rounded.begins_at_zero);
    EXPECT_EQ(labels(axis_ticks(rounded_axis("", {1.5, 30}, 1e-17), 0.1)),
              (Words{"1", "2", "5", "10", "20", "50"}));
}

TEST(RoundedAxis, ValuesThatAreNotPositiveStandAtItsLowEnd) {
    const ChartAxis rounded = rounded_axis("", {0, 1e-3}, 1e-17);
    EXPECT_NEAR(place_on(rounded, 0), 0, 1e-12);
    const Words words = labels(axis_ticks(rounded, 0.1));
    EXPECT_EQ(words.front(), "0");
    EXPECT_EQ(std::count(words.begin(), words.end(), "10⁻¹⁷"), 0);
}

TEST(Axes, HaveARangeWhateverTheirValues) {
    const std::vector<std::vector<double>> cases = {
        {}, {0}, {1}, {0, 0}, {infinity}, {1, infinity}, {1e-300, 1e300}, {nan}, {-3}};
    for (const std::vector<double>& values : cases) {
        for (const ChartAxis& chosen :
             {rounded_axis("", values, 1e-17), axis_over("", values, false, 0.04),
              axis_over("", values, true, 0.04)}) {
            EXPECT_LT(chosen.value(0), chosen.value(1));
            EXPECT_FALSE(axis_ticks(chosen, 0.05).empty());
            for (const double value : values) {
                EXPECT_GE(place_on(chosen, value), 0);
                EXPECT_LE(place_on(chosen, value), 1);
            }
        }
    }
}

}  // namespace
}  // namespace skybake
