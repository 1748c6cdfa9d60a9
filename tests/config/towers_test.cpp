#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "config/sections/towers.h"
#include "tests/config/clouds.h"

namespace skybake::config {

namespace {

using testing::cloud_of;
using testing::cloud_recipe;

std::string tower(const std::string& header, double amplitude) {
    return header +
           "\ncenter = [0, 0]\nsigma = [1, 1]\namplitude = " + fmt::format("{}\n", amplitude);
}

const std::string listed = "[[clouds.c.towers]]";

// "0:1 big:2": names and amplitudes, in the order of summation.
std::string towers_of(const Cloud& cloud) {
    std::string text;
    for (const Tower& each : cloud.towers) {
        text += fmt::format("{}{}:{}", text.empty() ? "" : " ", each.name, each.amplitude);
    }
    return text;
}

TEST(TowerList, ItemsAreNamedByTheirPlace) {
    EXPECT_EQ(towers_of(cloud_of(tower(listed, 1) + tower(listed, 2))), "0:1 1:2");
    EXPECT_EQ(towers_of(cloud_of("towers = []")), "");
    std::string many;
    std::string expected;
    for (int i = 0; i < 12; ++i) {
        many += tower(listed, i);
        expected += fmt::format("{}{}:{}", i == 0 ? "" : " ", i, i);
    }
    EXPECT_EQ(towers_of(cloud_of(many)), expected) << "as numbers, not as text";
}

TEST(TowerList, NumbersStandBeforeNames) {
    EXPECT_EQ(
        towers_of(cloud_of(tower("[clouds.c.towers.big]", 1) + tower("[clouds.c.towers.10]", 2) +
                           tower("[clouds.c.towers.9]", 3) + tower("[clouds.c.towers.-1]", 4) +
                           tower("[clouds.c.towers.009]", 5))),
        "009:5 9:3 10:2 -1:4 big:1");
    EXPECT_EQ(towers_of(cloud_of(tower("[clouds.c.towers.99999999999999999999999]", 1) +
                                 tower("[clouds.c.towers.100000000000000000000000]", 2))),
              "99999999999999999999999:1 100000000000000000000000:2");
}

// Lists are replaced as arrays are, and names merge as tables do.
TEST(TowerList, AListReplacesEarlierTowersAndNamesMerge) {
    const TemporaryFolder folder;
    folder.write("base.toml", cloud_recipe(tower(listed, 1) + tower(listed, 2)));
    const auto towers = [&](const std::string& over) {
        const auto file = folder.write("over.toml", "include = 'base.toml'\n" + over);
        const auto outcome = load_recipe(file);
        EXPECT_TRUE(outcome.value) << over;
        return outcome.value ? towers_of(outcome.value->parameters.clouds.at(0)) : "none";
    };
    EXPECT_EQ(towers(""), "0:1 1:2");
    EXPECT_EQ(towers(tower(listed, 3)), "0:3");
    EXPECT_EQ(towers("clouds.c.towers = []"), "");
    EXPECT_EQ(towers(tower("[clouds.c.towers.x]", 3)), "0:1 1:2 x:3");
    EXPECT_EQ(towers("[clouds.c.towers.1]\namplitude = 3"), "0:1 1:3");
}

Tower tower(double along, double across, double radians = 0, double correlation = 0) {
    Tower result;
    result.sigma = {along, across};
    result.rotation = {radians};
    result.correlation = correlation;
    return result;
}

TEST(TowerWidth, IsTheLesserSigmaInVoxels) {
    EXPECT_DOUBLE_EQ(narrowest_sigma(tower(0.1, 0.5), {100, 100, 7}), 10);
    EXPECT_DOUBLE_EQ(narrowest_sigma(tower(0.5, 0.1), {100, 20, 7}), 2);
    EXPECT_NEAR(narrowest_sigma(tower(0.1, 0.5, std::numbers::pi / 2), {100, 10, 7}), 1, 1e-12);
    EXPECT_DOUBLE_EQ(narrowest_sigma(tower(0.1, 0.5), {1, 100, 7}), 50);
    EXPECT_TRUE(std::isinf(narrowest_sigma(tower(0.1, 0.5), {1, 1, 7})));
    // r sigma^2 off the diagonal: eigenvalues (1 -+ r) sigma^2.
    EXPECT_NEAR(narrowest_sigma(tower(0.1, 0.1, 0.3, 0.75), {100, 100, 1}), 5, 1e-9);
}

// The deviation along a direction u is sqrt(u^T C u): no direction has less than the narrowest, and
// one of many nearly has it.
TEST(TowerWidth, NoDirectionIsNarrower) {
    EXPECT_TRUE(rc::check("narrowest_sigma == min over directions", [] {
        const auto share = [](int low, int high) { return *rc::gen::inRange(low, high) / 1000.0; };
        const Tower any = tower(share(10, 500), share(10, 500), share(0, 7000), share(-900, 900));
        const std::array<int, 3> size{*rc::gen::inRange(2, 300), *rc::gen::inRange(2, 300), 1};
        const double c = std::cos(any.rotation.radians);
        const double s = std::sin(any.rotation.radians);
        double narrowest = 1e30;
        for (int i = 0; i < 20000; ++i) {
            const double angle = std::numbers::pi * i / 20000;
            // u in tiles' units of the tower's own axes: R^T S u.
            const double x = std::cos(angle) * size[0];
            const double y = std::sin(angle) * size[1];
            const double p = (c * x + s * y) * any.sigma[0];
            const double q = (-s * x + c * y) * any.sigma[1];
            narrowest = std::min(narrowest, std::sqrt(p * p + q * q + 2 * any.correlation * p * q));
        }
        const double found = narrowest_sigma(any, size);
        RC_ASSERT(found <= narrowest * (1 + 1e-9));
        RC_ASSERT(found >= narrowest * (1 - 1e-2));
    }));
}

}  // namespace

}  // namespace skybake::config
