#include "bakers/report/measurement.h"

#include <gtest/gtest.h>

#include <limits>

namespace skybake {
namespace {

using Front = std::vector<bool>;

TEST(ParetoFront, KeepsWhatNothingBeats) {
    EXPECT_EQ(pareto_front({{1, 9}, {2, 4}, {3, 5}, {4, 1}, {5, 1}}),
              Front({true, true, false, true, false}));
}

TEST(ParetoFront, EqualChoicesShareTheirFate) {
    EXPECT_EQ(pareto_front({{1, 2}, {1, 2}, {2, 2}}), Front({true, true, false}));
}

TEST(ParetoFront, OfNothingIsEmptyAndOfOneIsThatOne) {
    EXPECT_TRUE(pareto_front({}).empty());
    EXPECT_EQ(pareto_front({{0, 0}}), Front({true}));
}

TEST(ParetoFront, WhatIsNotFiniteIsNeverOnIt) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(pareto_front({{1, nan}, {2, 1}, {nan, 0}}), Front({false, true, false}));
}

TEST(ParetoFront, CostsWithinTheNoiseAreTheSameWhereErrorsDiffer) {
    EXPECT_EQ(pareto_front({{1, 2}, {1.04, 1}}, 0.05), Front({false, true}));
    EXPECT_EQ(pareto_front({{1, 2}, {1.06, 1}}, 0.05), Front({true, true}));
    EXPECT_EQ(pareto_front({{1, 1}, {1.04, 1}}, 0.05), Front({true, false}));
}

}  // namespace
}  // namespace skybake
