// Textures of distances that are wrong, which the check of files and rays both find.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "tests/occupancy/distance_trial.h"
#include "tests/support/volumes.h"

namespace skybake::occupancy {
namespace {

using namespace test;
using Trial = test::DistanceTrial;

// Each fault changes the texture of a field, and both the check of files and rays find it.
void expect_found(const char* fault, const std::function<void(Trial&)>& change, bool loses = true) {
    Trial trial = field();
    ASSERT_FALSE(trial.check().failed());
    change(trial);
    const DistanceCheckResult found = trial.check();
    EXPECT_TRUE(found.failed()) << fault;
    if (!loses) return;
    EXPECT_GT(found.too_far, 0) << fault;
    std::int64_t steps = 0;
    EXPECT_GT(steps_that_lose(trial, 3000, steps), 0) << fault;
}

TEST(DistanceFaults, AreFound) {
    const auto metres = [](Trial& trial, double more) {
        for (float& value : trial.values) {
            if (trial.code.metres(double{value}) > 0) {
                value += static_cast<float>(more / (4096 + 256));
            }
        }
    };
    const std::array<int, 3> size = field().volume.grid.size();
    // The distance is rounded up to the diagonal of a texel that was taken off.
    const double diagonal = 2 * std::sqrt(25.0 * 25 + 20 * 20 + 30 * 30);
    expect_found("rounded up", [&](Trial& trial) { metres(trial, diagonal); });
    expect_found("x and z exchanged", [&](Trial& trial) {
        const std::vector<float> before = trial.values;
        testing::for_each_voxel(size, [&](int x, int y, int z) {
            trial.values[index_of(size, x, y, z)] =
                before[index_of(size, z * size[0] / size[2], y, x * size[2] / size[0])];
        });
    });
    expect_found(
        "zeros",
        [](Trial& trial) {
            for (float& value : trial.values) value = trial.code.surface();
        },
        false);
    expect_found("a flip",
                 [&](Trial& trial) { std::reverse(trial.values.begin(), trial.values.end()); });
    expect_found("a shift by two texels", [&](Trial& trial) {
        std::rotate(trial.values.begin(), trial.values.begin() + 2, trial.values.end());
    });
    expect_found("an old threshold", [](Trial& trial) {
        trial.values = Trial(trial.volume, trial.voxel_m, PixelType::unorm16, 0.4F).values;
    });
    expect_found(
        "a threshold that was higher",
        [](Trial& trial) {
            const Trial other(trial.volume, trial.voxel_m, PixelType::unorm16, 0.4F);
            trial.bits = other.bits;
            trial.threshold = 0.4F;
        },
        false);
    expect_found("edges exchanged", [](Trial& trial) {
        trial.values = Trial(trial.volume, {20, 25, 60}).values;
    });
}

// A cloud at the seam, in a tile between two tiles of nothing: distances that do not wrap.
TEST(DistanceFaults, AWrapLeftOutIsFound) {
    Volume volume = test::volume_of({{32, 32, 16}, 2});
    volume.at(1, 16, 8) = 1;
    Trial trial(volume, {20, 20, 20});
    ASSERT_FALSE(trial.check().failed());
    Volume wide = test::volume_of({{96, 32, 16}, 2});
    wide.at(1, 16, 8) = 1;
    const Trial unwrapped(wide, {20, 20, 20});
    testing::for_each_voxel({16, 16, 8}, [&](int x, int y, int z) {
        trial.values[index_of({16, 16, 8}, x, y, z)] =
            unwrapped.values[index_of({48, 16, 8}, x, y, z)];
    });
    EXPECT_GT(trial.check().too_far, 0);
    EXPECT_GT(trial.check().lost_steps, 0);
}

// The smallest excess that a stored value can have: the bound of a lookup is met closely.
TEST(DistanceFaults, HalfADiagonalTooFarIsFound) {
    Volume volume = test::volume_of({{32, 32, 32}, 1});
    volume.at(16, 16, 16) = 1;
    Trial trial(volume, {10, 10, 10}, PixelType::float32);
    ASSERT_FALSE(trial.check().failed());
    const double half = 5 * std::sqrt(3.0);
    for (float& value : trial.values) value += static_cast<float>(1.25 * half);
    EXPECT_GT(trial.check(20000).too_far, 0);
}

}  // namespace
}  // namespace skybake::occupancy
