#include "bakers/plan/choose_way.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace skybake {
namespace {

std::vector<WayFigures> some_ways() {
    return *rc::gen::container<std::vector<WayFigures>>(rc::gen::map(
        rc::gen::container<std::array<int, 4>>(rc::gen::inRange(1, 12)),
        [](const std::array<int, 4>& figures) {
            const auto [error, fetches, bytes, operations] = figures;
            return WayFigures{0.01 * error, 1.0 * fetches, 1024.0 * bytes, 1.0 * operations};
        }));
}

bool beats(const WayFigures& a, const WayFigures& b) {
    return a.error <= b.error && a.fetches <= b.fetches && a.bytes <= b.bytes &&
           a.operations <= b.operations &&
           (a.error < b.error || a.fetches < b.fetches || a.bytes < b.bytes ||
            a.operations < b.operations);
}

std::optional<double> some_limit(double unit) {
    const int limit = *rc::gen::inRange(0, 20);
    return limit == 0 ? std::nullopt : std::optional(unit * limit);
}

RC_GTEST_PROP(ChooseWay, NoBeatenWayIsChosen, ()) {
    const std::vector<WayFigures> ways = some_ways();
    RC_PRE(!ways.empty());
    const WayLimits limits{some_limit(0.01), some_limit(1), some_limit(1024)};
    const auto best = best_within(limits, ways, 0);
    const std::size_t knee = knee_of(ways);
    for (const WayFigures& way : ways) {
        RC_ASSERT(!beats(way, ways[knee]));
        if (best) RC_ASSERT(!beats(way, ways[*best]));
        if (!best) RC_ASSERT(!keeps(limits, way));
    }
    if (best) RC_ASSERT(keeps(limits, ways[*best]));
}

RC_GTEST_PROP(ChooseWay, ALooserErrorNeverTakesMoreFetches, ()) {
    const std::vector<WayFigures> ways = some_ways();
    const double error = 0.01 * *rc::gen::inRange(1, 20);
    const auto tight = best_within({error, {}, {}}, ways, 0);
    const auto loose = best_within({1.5 * error, {}, {}}, ways, 0);
    if (!tight) return;
    RC_ASSERT(loose.has_value());
    RC_ASSERT(ways[*loose].fetches <= ways[*tight].fetches);
}

RC_GTEST_PROP(ChooseWay, TheFrontIsWhatNoOtherBeats, ()) {
    const std::vector<WayFigures> ways = some_ways();
    const std::vector<bool> front = front_of(ways);
    for (std::size_t i = 0; i < ways.size(); ++i) {
        const bool beaten = std::any_of(ways.begin(), ways.end(),
                                        [&](const WayFigures& way) { return beats(way, ways[i]); });
        if (front[i]) RC_ASSERT(!beaten);
        if (!front[i] && !beaten) {  // then an equal one before it is there
            RC_ASSERT(std::any_of(ways.begin(), ways.begin() + static_cast<long>(i),
                                  [&](const WayFigures& way) {
                                      return !beats(way, ways[i]) && way.error == ways[i].error &&
                                             way.fetches == ways[i].fetches;
                                  }));
        }
    }
}

// Error first, then fetches, then operations, then bytes, of what has no limit.
TEST(ChooseWay, TakesTheLeastOfWhatHasNoLimit) {
    const std::vector<WayFigures> ways = {
        {0.01, 500, 1000}, {0.02, 100, 3000}, {0.02, 100, 2000}, {0.06, 1, 8000}, {0.5, 8, 10}};
    EXPECT_EQ(best_within({}, ways, 0), 0u);
    EXPECT_EQ(best_within({0.03, {}, {}}, ways, 0), 2u);
    EXPECT_EQ(best_within({0.1, {}, {}}, ways, 0), 3u);
    EXPECT_EQ(best_within({{}, 50, {}}, ways, 0), 3u);
    EXPECT_EQ(best_within({{}, 50, 100}, ways, 0), 4u);
    EXPECT_EQ(best_within({0.03, {}, 1500}, ways, 0), 0u);
    EXPECT_EQ(best_within({0.03, 50, {}}, ways, 0), std::nullopt);
    EXPECT_EQ(best_within({}, std::vector<WayFigures>{{0.1, 2, 64, 90}, {0.1, 2, 99, 80}}, 0), 1u);
}

// Twice the fetches for less than the noise are not taken.
TEST(ChooseWay, ErrorsWithinTheNoiseAreEqual) {
    const std::vector<WayFigures> ways = {
        {0.0085, 2944, 3000}, {0.0088, 1472, 1500}, {0.02, 64, 100}};
    EXPECT_EQ(best_within({{}, {}, 4000}, ways, 0.0024), 1u);
    EXPECT_EQ(best_within({{}, {}, 4000}, ways, 0.0001), 0u);
    EXPECT_EQ(best_within({0.01, {}, {}}, ways, 0.0024), 1u);
}

// Sixteen times the bytes or four times the fetches are worth half the error, and no more.
TEST(ChooseWay, TheKneeWeighsErrorAgainstCost) {
    EXPECT_EQ(knee_of(std::vector<WayFigures>{{0.04, 100, 100}, {0.019, 400, 100}}), 1u);
    EXPECT_EQ(knee_of(std::vector<WayFigures>{{0.04, 100, 100}, {0.021, 400, 100}}), 0u);
    EXPECT_EQ(knee_of(std::vector<WayFigures>{{0.04, 100, 1e6}, {0.019, 100, 16e6}}), 1u);
    EXPECT_EQ(knee_of(std::vector<WayFigures>{{0.04, 100, 1e6}, {0.021, 100, 16e6}}), 0u);
    EXPECT_EQ(knee_of(std::vector<WayFigures>{{0.04, 100, 100}, {0.039, 100, 100e3}}), 1u);
}

}  // namespace
}  // namespace skybake
