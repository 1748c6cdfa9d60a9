// The course of a tower's life: it grows, stays and dissolves, and the wind carries it.
#include "bakers/clouds/tower_field.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

#include "tests/clouds/living_towers.h"

namespace skybake::cloud {
namespace {

using config::Tower;
using test::at_time;
using test::fields_of;
using test::largest_difference;
using test::living_gaussian;
using test::living_tower;
using test::looping_cloud;
using test::plain_cloud;
using test::reference_state;

// f(1/4) = 5/32, f(1/2) = 1/2, f(3/4) = 27/32.
TEST(TowerLife, GrowsStaysAndDissolves) {
    const Cloud cloud = looping_cloud(8);
    const std::array<double, 8> height = {0, 0.15625, 0.5, 0.84375, 1, 1, 1, 1};
    const std::array<double, 8> amplitude = {0, 1, 1, 1, 1, 1, 1, 0.5};
    for (int frame = 0; frame < 8; ++frame) {
        const auto index = static_cast<std::size_t>(frame);
        const TowerState state = tower_state(living_tower(), 0, at_time(cloud, frame));
        EXPECT_EQ(state.height, height[index]) << frame;
        EXPECT_EQ(state.amplitude, amplitude[index]) << frame;
        EXPECT_DOUBLE_EQ(state.width, 0.4 + 0.6 * height[index]) << frame;
    }
}

TEST(TowerLife, AgreesWithTheReference) {
    EXPECT_TRUE(rc::check([] {
        Cloud cloud = looping_cloud(1);
        cloud.towers = {living_tower()};
        test::let_live(cloud);
        const Tower& tower = cloud.towers[0];
        const TowerState found = tower_state(tower, tower.born, cloud);
        const TowerState wanted = reference_state(tower, tower.born, cloud);
        // Births that fall on a frame may be rounded to its other side.
        if (found.amplitude == 0 || wanted.height < 1e-9) return;
        RC_ASSERT(std::fabs(found.height - wanted.height) <= 1e-9);
        RC_ASSERT(std::fabs(found.width - wanted.width) <= 1e-9);
        RC_ASSERT(std::fabs(found.amplitude - wanted.amplitude) <= 1e-9);
        for (std::size_t i = 0; i < 2; ++i) {
            RC_ASSERT(std::fabs(found.moved[i] - wanted.moved[i]) <= 1e-9);
        }
    }));
}

// The time since a birth that is later than a frame by rounding alone is 0 and not a whole loop.
TEST(TowerLife, BeginsAtItsFrameInSpiteOfRounding) {
    Cloud cloud = looping_cloud(8);
    cloud.drift = {3, -2};
    for (const double born : {1e-17, 1e-300, 0.0}) {
        EXPECT_EQ(tower_state(living_tower(), born, cloud).moved, (std::array<double, 2>{}))
            << born;
    }
}

TEST(TowerLife, IsNoneWithoutALoop) {
    const TowerState state = tower_state(living_tower(), 0.3, plain_cloud());
    EXPECT_EQ(state.height, 1);
    EXPECT_EQ(state.width, 1);
    EXPECT_EQ(state.amplitude, 1);
    EXPECT_EQ(state.moved, (std::array<double, 2>{}));
}

// --- Wind ---------------------------------------------------------------------------------------

// A tower that has drifted out of the tile comes in on the other side.
TEST(TowerWind, WrapsAroundTheTile) {
    Cloud drifting = looping_cloud(8);
    drifting.drift = {2.75, -1.5};
    drifting.towers = {living_tower(), living_gaussian()};
    Cloud placed = looping_cloud(8);
    placed.towers = drifting.towers;
    const double moved = 5 / 8.0;
    for (std::size_t i = 0; i < 2; ++i) {
        const auto within = [&](double place) { return place - std::floor(place); };
        const double tiles = drifting.drift[i] * moved;
        for (Tower& tower : placed.towers) tower.center[i] = within(tower.center[i] + tiles);
    }
    const auto found = fields_of(at_time(drifting, 5));
    const auto wanted = fields_of(at_time(placed, 5));
    EXPECT_LT(largest_difference(found, wanted), 1e-9);
    EXPECT_GT(largest_difference(found, fields_of(at_time(drifting, 4))), 0.1);
}

// A standing tower drifts too, by whole tiles per loop, and its birth does not matter.
TEST(TowerWind, CarriesStandingTowers) {
    Cloud cloud = looping_cloud(8);
    cloud.drift = {2, -1};
    cloud.towers = {living_tower()};
    cloud.towers[0].life = {};
    cloud.towers[0].born = 0.4;
    Cloud moved = plain_cloud();
    moved.towers = cloud.towers;
    moved.towers[0].center[0] += 2 * 3 / 8.0 - 1;
    moved.towers[0].center[1] -= 3 / 8.0;
    EXPECT_LT(largest_difference(fields_of(at_time(cloud, 3)), fields_of(moved)), 1e-9);
    EXPECT_EQ(fields_of(at_time(cloud, 8)), fields_of(at_time(cloud, 0)));
}

// --- Hard cases ---------------------------------------------------------------------------------

TEST(TowerLife, IsFiniteInHardCases) {
    for (const double grows_from : {0.0, 1.0}) {
        for (const auto& life : {std::array{1e-6, 0.0, 1e-6}, std::array{0.5, 0.0, 0.5},
                                 std::array{1e-300, 0.9, 0.1}}) {
            for (const int period : {1, 2, 999983}) {
                Cloud cloud = looping_cloud(period);
                cloud.drift = {16, -16};
                cloud.towers = {living_tower(), living_gaussian()};
                for (Tower& tower : cloud.towers) {
                    tower.life = life;
                    tower.grows_from = grows_from;
                    tower.born = 1;
                }
                for (const int time : {-1000000000, 0, 1, 1000000000}) {
                    for (const double value : fields_of(at_time(cloud, time))) {
                        ASSERT_TRUE(std::isfinite(value));
                        ASSERT_GE(value, 0);
                    }
                }
            }
        }
    }
}

}  // namespace
}  // namespace skybake::cloud
