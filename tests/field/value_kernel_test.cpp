// The vectors' results against going from value to value, and against Imath, for every instruction
// set.
#include "bakers/field/value_kernel.h"

#include <Imath/half.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include "tests/field/hard_floats.h"
#include "tests/support/every_target.h"

namespace skybake {
namespace {

TEST(ValueKernel, ConvertsToHalvesAndBackAsImath) {
    std::vector<float> values;
    testing::for_each_hard_float(7, [&](std::uint32_t bits) {
        const auto value = std::bit_cast<float>(bits);
        if (!std::isnan(value)) values.push_back(value);
    });
    test::on_every_target([&](const char*) {
        std::vector<std::uint16_t> halves(values.size());
        halves_of_floats(values.data(), values.size(), halves.data());
        for (std::size_t i = 0; i < values.size(); ++i) {
            ASSERT_EQ(halves[i], half(values[i]).bits()) << values[i];
        }
        std::vector<std::uint16_t> all;
        for (std::uint32_t bits = 0; bits < 1U << 16; ++bits) {
            if ((bits & 0x7fffU) <= 0x7c00U) all.push_back(static_cast<std::uint16_t>(bits));
        }
        std::vector<float> floats(all.size());
        floats_of_halves(all.data(), all.size(), floats.data());
        for (std::size_t i = 0; i < all.size(); ++i) {
            half wanted;
            wanted.setBits(all[i]);
            ASSERT_EQ(std::bit_cast<std::uint32_t>(floats[i]),
                      std::bit_cast<std::uint32_t>(static_cast<float>(wanted)));
        }
    });
}

// Floats next to the bounds between bytes, small ones, and the ends, in arrays of each length.
TEST(ValueKernel, RoundsToTheNearestByte) {
    std::vector<float> values = {0, 1, 1e-40f, 0x1p-30f, 0.5f};
    for (int byte = 0; byte < 255; ++byte) {
        float value = static_cast<float>((byte + 0.5) / 255);
        for (int i = 0; i < 4; ++i) value = std::nextafter(value, 0.0f);
        for (int i = 0; i < 8; ++i) values.push_back(value = std::nextafter(value, 1.0f));
    }
    test::on_every_target([&](const char*) {
        for (std::size_t count = 1; count <= values.size(); count += count < 80 ? 1 : 331) {
            std::vector<std::uint8_t> bytes(count + 1, 7);
            bytes_of_floats(values.data(), count, bytes.data());
            for (std::size_t i = 0; i < count; ++i) {
                const long double wanted = std::floor(255.0L * values[i] + 0.5L);
                ASSERT_EQ(bytes[i], static_cast<int>(wanted)) << values[i];
            }
            ASSERT_EQ(bytes[count], 7) << "beyond the end";
        }
    });
}

// One value among zeros, at each place of arrays of each length, is seen.
TEST(ValueKernel, SeesEachValue) {
    test::on_every_target([&](const char*) {
        for (std::size_t count = 1; count <= 80; ++count) {
            std::vector<float> values(count, 0.0f);
            ASSERT_TRUE(are_zeros(values.data(), count));
            ASSERT_TRUE(are_within(values.data(), count, 0, 1));
            ASSERT_EQ(count_below(values.data(), count, 1), 0);
            for (std::size_t i = 0; i < count; ++i) {
                for (const float value : {-0.0f, 1e-40f, 1.5f, NAN, -INFINITY}) {
                    values[i] = value;
                    ASSERT_FALSE(are_zeros(values.data(), count)) << count << ' ' << i;
                    ASSERT_EQ(are_within(values.data(), count, 0, 1), value >= 0 && value <= 1);
                    ASSERT_EQ(count_below(values.data(), count, 1), value == 1e-40f ? 1 : 0);
                }
                values[i] = 0;
            }
        }
    });
}

TEST(ValueKernel, AddsAndCountsAsFromValueToValue) {
    constexpr std::size_t kCount = 803;
    constexpr int kBins = 32;
    const std::array<double, 2> range = {-0.25, 0.75};
    std::vector<float> values(kCount);
    for (std::size_t i = 0; i < kCount; ++i) {
        values[i] = static_cast<float>(std::sin(static_cast<double>(i)) * (i % 3 == 0 ? 1 : 1e-3));
    }
    values[5] = 0.75f;
    values[6] = -0.25f;
    values[kCount - 1] = 0.75f;  // no whole vector holds it
    std::array<double, LaneSummary::kLanes> sums{};
    for (std::size_t i = 0; i < kCount; ++i) sums[i % LaneSummary::kLanes] += double{values[i]};
    test::on_every_target([&](const char*) {
        LaneSummary lanes;
        add_values(values.data(), 64, lanes);
        add_values(values.data() + 64, kCount - 64, lanes);
        EXPECT_EQ(lanes.sums, sums);
        EXPECT_EQ(*std::min_element(lanes.least.begin(), lanes.least.end()),
                  *std::min_element(values.begin(), values.end()));
        EXPECT_EQ(*std::max_element(lanes.most.begin(), lanes.most.end()),
                  *std::max_element(values.begin(), values.end()));
        std::vector<std::int32_t> bins(kCount);
        find_bins(values.data(), kCount, range, kBins / (range[1] - range[0]), kBins, bins.data());
        for (std::size_t i = 0; i < kCount; ++i) {
            const double place = (double{values[i]} - range[0]) * kBins;
            const bool inside = place >= 0 && place <= kBins;
            const int wanted = inside ? std::min(static_cast<int>(place), kBins - 1) : kBins;
            ASSERT_EQ(bins[i], wanted) << values[i];
        }
    });
}

}  // namespace
}  // namespace skybake
