// Clouds that grow and then go round in a loop.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "bakers/convection/convection.h"
#include "bakers/convection/flow.h"
#include "tests/convection/fields.h"
#include "tests/support/comparisons.h"

namespace skybake::convection {
namespace {

Specification looped() {
    Specification wanted = test::small();
    wanted.growth_s = 480;
    wanted.loop_s = 200;
    return wanted;
}

// What condenses in the flow of a specification after each of its steps.
struct States {
    std::vector<double> times_s;
    std::vector<std::vector<float>> water;

    explicit States(const Specification& wanted) {
        Flow flow(wanted, 1);
        for (const double end_s : {wanted.growth_s, wanted.growth_s + wanted.loop_s}) {
            while (flow.time_s() < end_s) {
                flow.step(end_s);
                times_s.push_back(flow.time_s());
                water.push_back(test::rows_of(
                    wanted, [&](int y, int z, float* out) { flow.condensed_row(y, z, out); }));
            }
        }
    }

    double at(double time_s, std::size_t cell) const {
        const auto after = std::ranges::lower_bound(times_s, time_s - 1e-9) - times_s.begin();
        const auto i = static_cast<std::size_t>(after);
        const double share = (time_s - times_s[i - 1]) / (times_s[i] - times_s[i - 1]);
        return (1 - share) * double{water[i - 1][cell]} + share * double{water[i][cell]};
    }
};

TEST(Loop, BeginsWithTheCloudThatStandsStill) {
    Specification still = looped();
    still.loop_s = 0;
    const auto moving = grow(looped(), {});
    EXPECT_GT(moving->moments, 10);
    EXPECT_EQ(at_share(moving, 0)->water, grow(still, {})->water);
    EXPECT_EQ(at_share(moving, 3)->water, at_share(moving, 0)->water);
}

TEST(Loop, IsItsFormulaOfTheStatesOfTheFlow) {
    const Specification wanted = looped();
    const States states(wanted);
    const auto moving = grow(wanted, {});
    double greatest = 0;
    for (const int moment : {1, moving->moments / 2, moving->moments - 1}) {
        const double f = double{1} * moment / moving->moments;
        const auto found = at_share(moving, f);
        for (std::size_t i = 0; i < found->water.size(); ++i) {
            const double now = states.at(wanted.growth_s + f * wanted.loop_s, i);
            const double before = states.at(wanted.growth_s + (f - 1) * wanted.loop_s, i);
            const double w = f * f * (3 - 2 * f);
            greatest = std::max(greatest, now);
            ASSERT_NEAR(double{found->water[i]}, (1 - w) * now + w * before, 1e-5) << moment;
        }
    }
    EXPECT_GT(greatest, 0.1);  // g/kg: there is cloud
}

TEST(Loop, HasNoJump) {
    const auto moving = grow(looped(), {});
    const auto change = [&](int moment) {
        const double step = 1.0 / moving->moments;
        return skybake::test::largest_difference(at_share(moving, moment * step)->water,
                                                 at_share(moving, (moment + 1) * step)->water);
    };
    double largest = 0;
    for (int i = 0; i + 1 < moving->moments; ++i) largest = std::max(largest, change(i));
    EXPECT_GT(largest, 0);
    EXPECT_LT(change(moving->moments - 1), largest);
    // Between moments it is linear, round the end as well.
    const auto middle = at_share(moving, -0.5 / moving->moments);
    const auto last = at_share(moving, -1.0 / moving->moments);
    const auto first = at_share(moving, 0);
    for (std::size_t i = 0; i < first->water.size(); ++i) {
        ASSERT_NEAR(middle->water[i], 0.5F * (last->water[i] + first->water[i]), 1e-6F);
    }
}

// The patches warm the air anew after the time of growth, so that clouds do not die out.
TEST(Loop, GoesOnByItsPatches) {
    const Specification wanted = looped();
    const PatchSource patches(wanted, make_sounding(wanted));
    const auto warmth_at = [&](double time_s) {
        Flow flow(wanted, 1);
        double before = 0, after = 0;
        const auto sum = [&](double& into) {
            for (int y = 0; y < wanted.grid.cells[1]; ++y) {
                const float* row = flow.state().heat.row(y, 0);
                for (int x = 0; x < wanted.grid.cells[0]; ++x) into += double{row[x]};
            }
        };
        sum(before);
        patches.warm(time_s, 2, 0, flow.state());
        sum(after);
        return after - before;
    };
    for (const int rounds : {0, 1, 2}) {
        EXPECT_GT(warmth_at((0.5 + rounds) * wanted.growth_s), 0) << rounds;
    }
    EXPECT_EQ(warmth_at(0), 0);  // no patch has begun
}

}  // namespace
}  // namespace skybake::convection
