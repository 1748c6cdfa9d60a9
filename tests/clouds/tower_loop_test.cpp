// The loop of towers that live: it repeats bit for bit, and nothing jumps in it.
#include <gtest/gtest.h>

#include <utility>

#include "bakers/clouds/cloud_field.h"
#include "tests/clouds/living_towers.h"

namespace skybake::cloud {
namespace {

using test::at_time;
using test::fields_of;
using test::largest_difference;
using test::lively_cloud;
using test::living_tower;
using test::looping_cloud;

TEST(TowerLoop, RepeatsBitForBit) {
    const Cloud cloud = lively_cloud(12);
    for (const int time : {0, 1, 7, 11}) {
        const std::vector<double> first = fields_of(at_time(cloud, time));
        for (const int loops : {1, -1, 80000000}) {
            EXPECT_EQ(fields_of(at_time(cloud, time + 12 * loops)), first) << time;
        }
        EXPECT_NE(fields_of(at_time(cloud, time + 1)), first) << time;
    }
}

// A birth that is put off by a frame puts everything off by a frame.
TEST(TowerLoop, BeginsAtTheBirth) {
    Cloud cloud = looping_cloud(16);
    cloud.drift = {0.25, 0};
    cloud.towers = {living_tower()};
    Cloud later = cloud;
    later.towers[0].born = 3.0 / 16;
    for (int time = 0; time < 16; ++time) {
        EXPECT_EQ(fields_of(at_time(later, time + 3)), fields_of(at_time(cloud, time))) << time;
    }
}

// Ten times as many frames make a tenth of the change between neighbours, also from the last to the
// first: nothing jumps.
TEST(TowerLoop, IsContinuousAllAround) {
    std::array<double, 2> largest{};
    for (const std::size_t i : {0u, 1u}) {
        const int period = i == 0 ? 30 : 300;
        const Cloud cloud = lively_cloud(period);
        std::vector<double> before = fields_of(at_time(cloud, -1));
        for (int time = 0; time < period; ++time) {
            std::vector<double> now = fields_of(at_time(cloud, time));
            largest[i] = std::max(largest[i], largest_difference(before, now));
            before = std::move(now);
        }
    }
    EXPECT_GT(largest[0], 0.05);
    EXPECT_LT(largest[1], largest[0] / 5);
}

// Voxels of the whole cloud, with a noise that moves too.
TEST(TowerLoop, OfACloudsVoxelsRepeatsBitForBit) {
    test::CloudCase any = test::plain_case({20, 18, 12});
    any.cloud = lively_cloud(6);
    any.base.period = 6;
    any.base.drift = {1, 0, 0};
    const auto voxels_at = [&](int time) {
        any.cloud.time = any.base.time = time;
        return test::filled(CloudField(any.plan()), {{}, any.size}, 1);
    };
    EXPECT_EQ(voxels_at(6), voxels_at(0));
    EXPECT_EQ(voxels_at(-1), voxels_at(5));
    EXPECT_NE(voxels_at(5), voxels_at(0));
}

}  // namespace
}  // namespace skybake::cloud
