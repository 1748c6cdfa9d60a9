// The ranks of blue noise: against a reference that sums every energy anew, and what must hold of
// them for any shape.
#include "bakers/noise/void_and_cluster.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "bakers/assets/blue_noise/mask_figures.h"
#include "bakers/noise/torus_energy.h"
#include "tests/noise/void_and_cluster_reference.h"
#include "tests/support/cancelled_at.h"
#include "tests/support/every_target.h"

namespace skybake {
namespace {

using noise::MaskShape;

std::vector<std::uint32_t> ranks_of(const MaskShape& shape) {
    return noise::void_and_cluster_ranks(shape, {});
}

void expect_reference(const MaskShape& shape) {
    std::vector<std::uint32_t> wanted;
    for (const std::vector<int>& frame : test::MaskReference(shape).ranks()) {
        wanted.insert(wanted.end(), frame.begin(), frame.end());
    }
    test::on_every_target([&](const char* name) {
        EXPECT_EQ(ranks_of(shape), wanted) << name << ", " << shape.size[0] << " pixels across";
    });
}

TEST(VoidAndCluster, IsTheReferenceThatSumsEveryEnergyAnew) {
    expect_reference({{13, 9, 1}, 1.9, 1.9, 3});
    expect_reference({{8, 6, 3}, 1.2, 0.8, 7});  // the stamp is wider than the torus
    expect_reference({{5, 7, 4}, 1.9, 1.9, 0});
    expect_reference({{40, 3, 1}, 1, 1, 1});  // wider than the stamp along x alone
}

TEST(VoidAndCluster, TinyShapesHaveTheirRanks) {
    EXPECT_EQ(ranks_of({{1, 1, 1}}), std::vector<std::uint32_t>{0});
    EXPECT_EQ(ranks_of({{1, 1, 3}}), (std::vector<std::uint32_t>{0, 0, 0}));
    expect_reference({{2, 1, 1}});
    expect_reference({{1, 3, 2}});
}

TEST(VoidAndCluster, AnotherSeedIsAnotherMask) {
    EXPECT_NE(ranks_of({{16, 16, 2}, 1.9, 1.9, 1}), ranks_of({{16, 16, 2}, 1.9, 1.9, 2}));
}

RC_GTEST_PROP(VoidAndCluster, EveryFrameHasEachRankOnce, ()) {
    MaskShape shape;
    shape.size = {*rc::gen::inRange(1, 24), *rc::gen::inRange(1, 24), *rc::gen::inRange(1, 6)};
    shape.spatial_sigma = *rc::gen::inRange(5, 40) / 10.0;
    shape.temporal_sigma = *rc::gen::inRange(5, 40) / 10.0;
    shape.seed = *rc::gen::arbitrary<std::uint64_t>();
    const std::vector<std::uint32_t> ranks = ranks_of(shape);
    const auto pixels = static_cast<std::size_t>(shape.size[0] * shape.size[1]);
    RC_ASSERT(ranks.size() == pixels * static_cast<std::size_t>(shape.size[2]));
    std::vector<std::vector<bool>> seen(ranks.size() / pixels, std::vector<bool>(pixels));
    for (std::size_t i = 0; i < ranks.size(); ++i) {
        RC_ASSERT(ranks[i] < pixels);
        RC_ASSERT(!seen[i / pixels][ranks[i]]);
        seen[i / pixels][ranks[i]] = true;
    }
}

// After any choice the extremes are the first of all pixels that have those energies.
TEST(TorusEnergy, ExtremesAreTheFirstOfTheirEnergies) {
    for (const auto& [width, height] : {std::pair{13, 9}, {16, 3}, {40, 33}}) {
        noise::TorusEnergy energy({width, height, 3}, 0.7, 0.8);
        const auto pixels = static_cast<std::size_t>(width * height);
        std::vector<std::vector<int>> chosen(3, std::vector<int>(pixels));
        const auto expect_first = [&](std::size_t frame, int state, std::size_t found) {
            const auto gap = [&](std::size_t pixel) {  // grows from the extreme on
                return (state == 1 ? ~std::uint64_t{0} : 0) ^ energy.at(frame, pixel);
            };
            for (std::size_t i = 0; i < pixels; ++i) {
                if (chosen[frame][i] != state) continue;
                ASSERT_LE(gap(found) + (i < found ? 1 : 0), gap(i)) << width << ' ' << frame;
            }
        };
        for (std::size_t step = 0; step < 300; ++step) {
            const std::size_t at = noise::first_hash(5, step % 3, step / 2 % 90) % pixels;
            int& state = chosen[step % 3][at];
            state == 1 ? energy.remove(step % 3, at) : energy.add(step % 3, at);
            state = 1 - state;
            for (std::size_t frame = 0; step > 2 && frame < 3; ++frame) {
                expect_first(frame, 0, energy.largest_void(frame).pixel);
                expect_first(frame, 1, energy.tightest_cluster(frame).pixel);
            }
        }
    }
}

TEST(VoidAndCluster, AnInterruptionLeavesNothing) {
    testing::CancelledAt progress("", 0);
    BakeOptions options;
    options.progress = &progress;
    EXPECT_TRUE(noise::void_and_cluster_ranks({{16, 16, 2}}, options).empty());
}

// The figures are shares of what white noise has; see the values that each kind of noise reached.
struct Figures {
    double of_frames = 0;
    double over_time = 0;
};

Figures figures_of(const std::array<int, 3>& size, const std::vector<std::uint32_t>& ranks) {
    std::vector<float> values;
    for (const std::uint32_t rank : ranks) {
        values.push_back((static_cast<float>(rank) + 0.5F) / static_cast<float>(size[0] * size[1]));
    }
    const MaskView mask{size, &values};
    return {low_power_of_frames(mask), low_power_over_time(mask)};
}

// Each frame a random permutation.
std::vector<std::uint32_t> white_ranks(const std::array<int, 3>& size) {
    std::vector<std::uint32_t> frame(static_cast<std::size_t>(size[0] * size[1]));
    std::iota(frame.begin(), frame.end(), 0U);
    std::vector<std::uint32_t> ranks;
    std::mt19937 random(9);
    for (int i = 0; i < size[2]; ++i) {
        std::shuffle(frame.begin(), frame.end(), random);
        ranks.insert(ranks.end(), frame.begin(), frame.end());
    }
    return ranks;
}

// Low frequencies have almost no power in frames, and little over time: 0.14 % and 2 % of white
// noise's. Frames that are made one by one are blue by themselves and white over time, and white
// noise is white in both.
TEST(VoidAndCluster, IsBlueInFramesAndOverTime) {
    const std::array<int, 3> size = {48, 48, 16};
    const Figures mask = figures_of(size, ranks_of({size}));
    EXPECT_LT(mask.of_frames, 0.002);
    EXPECT_LT(mask.over_time, 0.06);

    std::vector<std::uint32_t> apart;
    for (std::uint64_t frame = 0; frame < 16; ++frame) {
        const std::vector<std::uint32_t> one = ranks_of({{48, 48, 1}, 1.9, 1.9, frame});
        apart.insert(apart.end(), one.begin(), one.end());
    }
    const Figures of_apart = figures_of(size, apart);
    EXPECT_LT(of_apart.of_frames, 0.002);
    EXPECT_NEAR(of_apart.over_time, 1, 0.1);

    const Figures white = figures_of(size, white_ranks(size));
    EXPECT_NEAR(white.of_frames, 1, 0.1);
    EXPECT_NEAR(white.over_time, 1, 0.1);
}

}  // namespace
}  // namespace skybake
