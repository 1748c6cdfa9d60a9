// The kernels between noise and cloud by themselves, at values that just are and just are not above
// a level: of noises that a whole field is made of hardly any hits one to the bit.
#include "bakers/clouds/shape_kernel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/noise/every_target.h"

namespace skybake::cloud {
namespace {

constexpr float kLevel = 0.25f;
const float kJustAbove = std::nextafter(kLevel, 1.0f);
const float kJustBelow = std::nextafter(kLevel, 0.0f);
// Longer than two of the longest vectors, and ends in any lane of one.
constexpr std::size_t kLongest = 2 * 16 + 15;
constexpr float kBeyond = 77;

std::vector<float> row_of(std::size_t count) {
    const std::vector<float> values = {kLevel, kJustAbove, kJustBelow, 0, -1, 1, 0.5f};
    std::vector<float> row;
    for (std::size_t i = 0; i < count; ++i) row.push_back(values[i % values.size()]);
    return row;
}

// Calls change(count, values) for rows of every length on every instruction set; each value must
// become wanted(value), and nothing beyond the row may change.
template <class Change, class Wanted>
void expect_rows(const Change& change, const Wanted& wanted) {
    test::on_every_target([&](const char* target) {
        for (std::size_t count = 1; count <= kLongest; ++count) {
            const std::vector<float> before = row_of(count);
            std::vector<float> values = before;
            values.push_back(kBeyond);
            change(count, values.data());
            for (std::size_t i = 0; i < count; ++i) {
                EXPECT_EQ(values[i], wanted(before[i]))
                    << target << ", value " << before[i] << " at " << i << " of " << count;
            }
            EXPECT_EQ(values.back(), kBeyond) << target << ' ' << count;
        }
    });
}

CloudPlan plan_with_softness(float softness) {
    CloudPlan plan;
    plan.threshold = kLevel;
    plan.inverse_softness = softness > 0 ? 1 / softness : 0;
    return plan;
}

TEST(ShapeKernel, AHardThresholdKeepsOnlyWhatIsAboveIt) {
    const CloudPlan plan = plan_with_softness(0);
    expect_rows([&](std::size_t count, float* values) { finish(plan, 0.7F, count, values); },
                [](float v) { return v > kLevel ? v * 0.7F : 0.0f; });
}

TEST(ShapeKernel, ASoftEdgeBeginsAtTheThreshold) {
    const CloudPlan plan = plan_with_softness(0.5f);
    expect_rows([&](std::size_t count, float* values) { finish(plan, 0.7F, count, values); },
                [](float v) {
                    const float x = std::clamp((v - kLevel) * 2, 0.0f, 1.0f);
                    return std::max(v, 0.0f) * ((x * x) * (3 - 2 * x)) * 0.7F;
                });
}

TEST(ShapeKernel, AThresholdOfTheRuntimeLeavesValuesAsTheyAre) {
    CloudPlan plan = plan_with_softness(0);
    plan.threshold_in_file = false;
    expect_rows([&](std::size_t count, float* values) { finish(plan, 0.7F, count, values); },
                [](float v) { return std::max(v, 0.0f); });
}

TEST(ShapeKernel, ErodesWhatIsAboveTheLevel) {
    // Detail beyond [0, 1] is cut off.
    const SliceShape slice = {{}, 0.5f, 0.25f};
    for (const float detail : {-3.0f, 0.0f, 0.25f, 0.5f, 1.0f, 9.0f}) {
        const std::vector<float> details(kLongest, detail);
        const float d = std::clamp(detail, 0.0f, 1.0f);
        const float e = 0.5f * (d + 0.25f * (1 - 2 * d));
        expect_rows([&](std::size_t count,
                        float* values) { erode(slice, details.data(), kLevel, count, values); },
                    [&](float b) { return b > kLevel ? (b - e) / (1 - e) : 0.0f; });
    }
}

// Whether anything is above the level, wherever in the row it stands.
TEST(ShapeKernel, SaysWhetherARowHoldsAnything) {
    SliceShape slice;
    slice.profile = {0.5f, 0, 0};
    const std::vector<float> towers(kLongest, 0.5f);
    const std::vector<float> offset(kLongest, 0.0f);
    const ColumnRow columns = {towers.data(), offset.data(), nullptr, nullptr};
    test::on_every_target([&](const char* target) {
        for (std::size_t count = 1; count <= kLongest; ++count) {
            std::vector<float> values(count, kLevel);
            EXPECT_FALSE(shape_base(slice, columns, kLevel, count, values.data())) << target;
            EXPECT_EQ(values, std::vector<float>(count, kLevel)) << target;
            for (std::size_t i = 0; i < count; ++i) {
                values.assign(count, kLevel);
                values[i] = kJustAbove;
                EXPECT_TRUE(shape_base(slice, columns, kLevel, count, values.data()))
                    << target << ' ' << i << " of " << count;
                EXPECT_EQ(values[i], kJustAbove);
            }
        }
    });
}

// P + (P' - P) w' + (P'' - P') w'' of the three classic types, towers on top, coverage below.
TEST(ShapeKernel, BlendsTypesColumnByColumn) {
    const SliceShape slice = {{0.25f, 0.75f, 0.5f}, 0, 1};
    std::vector<float> towers, offset, second, third;
    for (std::size_t i = 0; i < kLongest; ++i) {
        towers.push_back(static_cast<float>(i % 3) * 0.5f);
        offset.push_back(static_cast<float>(i % 4) * -0.125f);
        second.push_back(static_cast<float>(i % 5) * 0.25f);
        third.push_back(static_cast<float>(i % 2) * 0.5f);
    }
    const ColumnRow columns = {towers.data(), offset.data(), second.data(), third.data()};
    test::on_every_target([&](const char* target) {
        std::vector<float> values = row_of(kLongest);
        const std::vector<float> noise = values;
        shape_base(slice, columns, 0, kLongest, values.data());
        for (std::size_t i = 0; i < kLongest; ++i) {
            const float profile = 0.25f + 0.5f * second[i] - 0.25f * third[i];
            EXPECT_EQ(values[i], noise[i] * (profile + towers[i]) + offset[i])
                << target << ' ' << i;
        }
    });
}

}  // namespace
}  // namespace skybake::cloud
