#include "bakers/plot/log_axis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace skybake {
namespace {

TEST(LogAxis, EndsAtRoundFiguresBeyondItsValues) {
    const LogAxis axis({0.3, 70}, 1e-17);
    EXPECT_DOUBLE_EQ(axis.low(), 0.2);
    EXPECT_DOUBLE_EQ(axis.high(), 100);
    EXPECT_DOUBLE_EQ(axis.position(0.2), 0);
    EXPECT_DOUBLE_EQ(axis.position(100), 1);
    EXPECT_NEAR(axis.position(std::sqrt(20.0)), 0.5, 1e-12);
}

TEST(LogAxis, LabelsPowersOfTen) {
    std::string labels;
    for (const LogTick& tick : LogAxis({2e-5, 3000}, 1e-17).ticks()) labels += tick.label + " ";
    EXPECT_NE(labels.find("1e-5"), std::string::npos);
    EXPECT_NE(labels.find("0.01"), std::string::npos);
    EXPECT_NE(labels.find(" 1 "), std::string::npos);
    EXPECT_NE(labels.find("1000"), std::string::npos);
    EXPECT_EQ(labels.find("5e-5"), std::string::npos);
}

TEST(LogAxis, AShortOneLabelsTwosAndFives) {
    std::string labels;
    for (const LogTick& tick : LogAxis({1.5, 30}, 1e-17).ticks()) labels += tick.label + " ";
    EXPECT_EQ(labels, "1 2 5 10 20 50 ");
}

TEST(LogAxis, ValuesThatAreNotPositiveStandAtItsLowEnd) {
    const LogAxis axis({0, 1e-3}, 1e-17);
    EXPECT_DOUBLE_EQ(axis.low(), 1e-17);
    EXPECT_DOUBLE_EQ(axis.position(0), 0);
    EXPECT_EQ(axis.ticks().front().label, "0");
}

TEST(LogAxis, HasARangeWhateverItsValues) {
    const double infinity = std::numeric_limits<double>::infinity();
    const std::vector<std::vector<double>> cases = {
        {}, {0}, {1}, {0, 0}, {infinity}, {1, infinity}, {1e-300, 1e300}};
    for (const std::vector<double>& values : cases) {
        const LogAxis axis(values, 1e-17);
        EXPECT_LT(axis.low(), axis.high());
        EXPECT_GE(axis.ticks().size(), 2u);
        for (const double value : values) {
            EXPECT_GE(axis.position(value), 0);
            EXPECT_LE(axis.position(value), 1);
        }
    }
}

}  // namespace
}  // namespace skybake
