#include "bakers/field/survey_volume.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>

#include "bakers/field/baked.h"
#include "bakers/field/pixel_type.h"
#include "bakers/math/hash.h"
#include "tests/support/cancelled_at.h"
#include "tests/support/volumes.h"

namespace skybake {
namespace {

using testing::plain_volume;
using Ranges = std::vector<std::array<double, 2>>;

constexpr std::array<PixelType, 4> kTypes = {PixelType::float32, PixelType::half, PixelType::unorm8,
                                             PixelType::unorm16};

// The same figures by going from voxel to voxel.
Level by_hand(const Baked& volume, const Ranges& ranges) {
    const Level& level = volume.levels[0];
    Level result = level;
    const std::size_t channels = volume.channel_names.size();
    result.statistics.assign(channels, {});
    std::string bytes;
    for (std::size_t c = 0; c < channels; ++c) {
        result.statistics[c].min = std::numeric_limits<double>::infinity();
        result.statistics[c].max = -std::numeric_limits<double>::infinity();
        result.statistics[c].histogram.assign(kHistogramBins, 0);
    }
    const auto planes = testing::planes_of(*level.voxels, {{}, level.size}, channels);
    for (std::size_t i = 0; i < planes[0].size(); ++i) {
        std::vector<float> voxel;
        for (const std::vector<float>& plane : planes) voxel.push_back(plane[i]);
        for (std::size_t c = 0; c < channels; ++c) {
            const double value = round_to_pixel_type(voxel[c], volume.pixel_type);
            ValueStatistics& statistics = result.statistics[c];
            statistics.min = std::min(statistics.min, value);
            statistics.max = std::max(statistics.max, value);
            statistics.mean += value;
            const double place =
                (value - ranges[c][0]) / (ranges[c][1] - ranges[c][0]) * kHistogramBins;
            if (place < 0 || place > kHistogramBins) continue;
            ++statistics.histogram[std::min<std::size_t>(static_cast<std::size_t>(place),
                                                         kHistogramBins - 1)];
        }
        std::string piece(channels * bytes_per_value(volume.pixel_type), '\0');
        store_values(voxel.data(), channels, volume.pixel_type, piece.data());
        bytes += piece;
    }
    for (ValueStatistics& statistics : result.statistics) {
        statistics.mean /= static_cast<double>(VoxelBox{{}, level.size}.count());
    }
    result.content_hash = xxh3_hex(bytes);
    return result;
}

TEST(SurveyVolume, AgreesWithAPassFromVoxelToVoxel) {
    const Ranges ranges = {{0, 1}, {0.25, 0.75}, {-1, 1}, {0, 0.5}};
    for (const PixelType type : kTypes) {
        for (const int channels : {1, 3, 4}) {
            for (const std::array<int, 3> size : {std::array{1, 1, 1}, {13, 1, 7}, {31, 17, 5}}) {
                Baked volume = plain_volume(size, channels, type);
                ASSERT_TRUE(survey_level(volume, 0, ranges, {2}).empty());
                const Level wanted = by_hand(volume, ranges);
                const Level& found = volume.levels[0];
                EXPECT_EQ(found.content_hash, wanted.content_hash);
                for (std::size_t c = 0; c < volume.channel_names.size(); ++c) {
                    const ValueStatistics& a = found.statistics[c];
                    const ValueStatistics& b = wanted.statistics[c];
                    EXPECT_EQ(a.min, b.min);
                    EXPECT_EQ(a.max, b.max);
                    EXPECT_NEAR(a.mean, b.mean, 1e-14);
                    EXPECT_EQ(a.histogram, b.histogram);
                    EXPECT_EQ(a.histogram_range, ranges[c]);
                }
            }
        }
    }
}

TEST(SurveyVolume, DoesNotDependOnThreads) {
    std::string hash;
    double mean = 0;
    for (const int threads : {1, 2, 5}) {
        Baked volume = plain_volume({211, 97, 113}, 4, PixelType::half);
        ASSERT_TRUE(survey_level(volume, 0, Ranges(4, {0, 1}), {threads}).empty());
        if (threads == 1) {
            hash = volume.levels[0].content_hash;
            mean = volume.levels[0].statistics[3].mean;
        }
        EXPECT_EQ(volume.levels[0].content_hash, hash);
        EXPECT_EQ(volume.levels[0].statistics[3].mean, mean);
    }
}

TEST(SurveyVolume, NamesTheFirstValueThatNoFileHolds) {
    const float infinity = std::numeric_limits<float>::infinity();
    struct Case {
        PixelType type;
        float bad;
        const char* code;
    };
    const Case cases[] = {
        {PixelType::float32, infinity, "E0401"},
        {PixelType::float32, std::nanf(""), "E0401"},
        {PixelType::half, -infinity, "E0401"},
        {PixelType::half, std::nextafter(65504.0F, 1e9F), "E0402"},
        {PixelType::half, -1e6F, "E0402"},
        {PixelType::unorm8, std::nextafter(1.0F, 2.0F), "E0402"},
        {PixelType::unorm8, -std::numeric_limits<float>::denorm_min(), "E0402"},
        {PixelType::unorm16, 1.5F, "E0402"},
        {PixelType::unorm16, std::nanf(""), "E0401"},
    };
    for (const Case& entry : cases) {
        const auto voxel = [&](int x, int y, int z, int channel) {
            if (channel == 1 && x == 5 && y == 3 && z == 20) return entry.bad;
            const bool behind = (channel == 0 && x == 6 && y == 3 && z == 20) || z == 39;
            return behind ? infinity : 0.5F;
        };
        Baked volume = plain_volume({300, 400, 40}, 3, entry.type, voxel);
        const auto diagnostics = survey_level(volume, 0, Ranges(3, {0, 1}), {2});
        ASSERT_EQ(diagnostics.size(), 1U);
        EXPECT_TRUE(volume.levels[0].content_hash.empty());
        const std::string& message = diagnostics[0].message;
        EXPECT_EQ(diagnostics[0].code, entry.code) << message;
        EXPECT_NE(message.find("`shape`: the value at voxel (5, 3, 20), channel G,"),
                  std::string::npos)
            << message;
    }
}

TEST(SurveyVolume, TakesWhatIsJustInRange) {
    const auto constant = [](float value) { return [value](int, int, int, int) { return value; }; };
    Baked half = plain_volume({4, 4, 4}, 1, PixelType::half, constant(-65504.0F));
    EXPECT_TRUE(survey_level(half, 0, {{0, 1}}, {1}).empty());
    EXPECT_EQ(half.levels[0].statistics[0].min, -65504);
    EXPECT_EQ(half.levels[0].statistics[0].histogram, std::vector<std::int64_t>(32, 0));
    Baked unorm = plain_volume({4, 4, 4}, 1, PixelType::unorm8, constant(1.0F));
    EXPECT_TRUE(survey_level(unorm, 0, {{0, 1}}, {1}).empty());
    EXPECT_EQ(unorm.levels[0].statistics[0].histogram[31], 64);
    Baked zero = plain_volume({4, 4, 4}, 1, PixelType::unorm8, constant(-0.0F));
    EXPECT_TRUE(survey_level(zero, 0, {{0, 1}}, {1}).empty());
    EXPECT_FALSE(std::signbit(zero.levels[0].statistics[0].min));
}

TEST(SurveyVolume, CountsValuesThatLoseDigits) {
    const auto tiny = [](int x, int, int, int) { return x == 0 ? 0.0F : 1e-5F; };
    Baked half = plain_volume({3, 4, 4}, 1, PixelType::half, tiny);
    EXPECT_TRUE(survey_level(half, 0, {{0, 1}}, {1}).empty());
    EXPECT_EQ(half.range.below_normal, 32);
    Baked single = plain_volume({3, 4, 4}, 1, PixelType::float32, tiny);
    EXPECT_TRUE(survey_level(single, 0, {{0, 1}}, {1}).empty());
    EXPECT_EQ(single.range.below_normal, 0);
}

TEST(SurveyVolume, AnInterruptionFillsNothing) {
    std::atomic<int> asked = 0;
    Baked volume = plain_volume({1024, 1024, 1000}, 1, PixelType::half, [&](int, int, int, int) {
        ++asked;
        return 0.5F;
    });
    testing::CancelledAt progress("", 2);
    EXPECT_TRUE(survey_level(volume, 0, {{0, 1}}, {2, Certification::off, &progress}).empty());
    EXPECT_TRUE(volume.levels[0].content_hash.empty());
    EXPECT_TRUE(volume.levels[0].statistics.empty());
    EXPECT_LT(asked, 32 << 20);
}

}  // namespace
}  // namespace skybake
