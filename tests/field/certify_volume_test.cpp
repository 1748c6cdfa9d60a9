#include "bakers/field/certify.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "bakers/field/pixel_type.h"
#include "bakers/field/survey_volume.h"
#include "tests/field/looked_up.h"
#include "tests/support/volumes.h"

namespace skybake {
namespace {

using testing::FunctionVoxels;
using testing::looked_up;
using testing::plain_volume;
using testing::sample_voxel;
using Point = std::array<double, 3>;

// The level of a volume whose statistics are known.
Level level_of(const std::array<int, 3>& size, int channels, PixelType type,
               FunctionVoxels::Function function) {
    Baked volume = plain_volume(size, channels, type, std::move(function));
    const std::vector<std::array<double, 2>> ranges(static_cast<std::size_t>(channels), {0, 1});
    EXPECT_TRUE(survey_level(volume, 0, ranges, {}).empty());
    return volume.levels[0];
}

TEST(CertifyVolume, ConstantsAreExact) {
    for (const PixelType type : {PixelType::float32, PixelType::half, PixelType::unorm8}) {
        const float value = round_to_pixel_type(0.4, type);
        const Level level = level_of({7, 5, 1}, 1, type, [=](int, int, int, int) { return value; });
        const auto reference = [=](const Point&) { return std::vector<double>{double{value}}; };
        EXPECT_LT(measure_lookups(level, type, reference, 200, {}).figures.max, 1e-15);
        EXPECT_EQ(measure_voxels(level, type, reference, 200, {}).points, 200);
        EXPECT_LT(measure_voxels(level, type, reference, 200, {}).figures.max, 1e-15);
        // Without a range, the difference itself.
        const auto other = [=](const Point&) { return std::vector<double>{double{value} + 0.25}; };
        EXPECT_NEAR(measure_lookups(level, type, other, 50, {}).figures.max, 0.25, 1e-12);
        EXPECT_NEAR(measure_lookups(level, type, other, 50, {}).figures.rms, 0.25, 1e-12);
    }
}

// A bump a t (1 - t) between voxels along x, and nothing at them, is what a trilinear lookup
// misses: a / 4 at most, sqrt(1/30) a of root mean square.
TEST(CertifyVolume, FindsAKnownErrorBetweenVoxels) {
    const std::array<int, 3> size = {8, 6, 4};
    const Level level = level_of(size, 1, PixelType::float32, sample_voxel);
    const double range = level.statistics[0].max - level.statistics[0].min;
    const double a = 0.01;
    const auto reference = [&](const Point& uvw) {
        const double position = uvw[0] * size[0] - 0.5;
        const double t = position - std::floor(position);
        return std::vector<double>{looked_up(sample_voxel, size, PixelType::float32, 0, uvw) +
                                   a * t * (1 - t)};
    };
    const VolumeErrors errors = measure_lookups(level, PixelType::float32, reference, 2000, {});
    EXPECT_EQ(errors.points, 2000);
    EXPECT_NEAR(errors.figures.max, a / 4 / range, 1e-6);
    EXPECT_NEAR(errors.figures.rms, a / std::sqrt(30.0) / range, 0.01 * a / range);
    // The worst is in the middle between two voxels.
    const double position = errors.worst[0] * size[0] - 0.5;
    EXPECT_NEAR(position - std::floor(position), 0.5, 0.01);
    // At voxels there is none of it.
    EXPECT_LT(measure_voxels(level, PixelType::float32, reference, 192, {}).figures.max, 1e-12);
}

TEST(CertifyVolume, CountsRoundingAtVoxels) {
    const std::array<int, 3> size = {16, 16, 16};
    for (const PixelType type : {PixelType::half, PixelType::unorm8, PixelType::unorm16}) {
        const Level level = level_of(size, 3, type, sample_voxel);
        const auto exact = [&](const Point& uvw) {
            std::vector<double> values;
            for (int c = 0; c < 3; ++c) {
                values.push_back(double{sample_voxel(static_cast<int>(uvw[0] * 16),
                                                     static_cast<int>(uvw[1] * 16),
                                                     static_cast<int>(uvw[2] * 16), c)});
            }
            return values;
        };
        const double range = level.statistics[0].max - level.statistics[0].min;
        const VolumeErrors errors = measure_voxels(level, type, exact, 3000, {});
        // Half a step at values near 1: 2^-12 of halves.
        const double half_step = type == PixelType::half ? 0x1p-12 : rounding_error(type);
        EXPECT_LE(errors.figures.max, half_step / range * 1.01);
        EXPECT_GE(errors.figures.max, half_step * 0.98);
        EXPECT_LT(errors.figures.rms, errors.figures.max);
    }
}

// Channels of ranges 1, 100 and 0.001, one of which is off by 3 % of its range.
TEST(CertifyVolume, EachChannelIsMeasuredByItsOwnRange) {
    const std::array<int, 3> size = {6, 5, 4};
    const auto scaled = [](int x, int y, int z, int c) {
        constexpr std::array<float, 3> kScale = {1, 100, 1e-3F};
        return kScale[static_cast<std::size_t>(c)] * sample_voxel(x, y, z, c);
    };
    const Level level = level_of(size, 3, PixelType::float32, scaled);
    for (std::size_t off = 0; off < 3; ++off) {
        const ValueStatistics& s = level.statistics[off];
        const auto reference = [&](const Point& uvw) {
            std::vector<double> values;
            for (int c = 0; c < 3; ++c) {
                values.push_back(looked_up(scaled, size, PixelType::float32, c, uvw));
            }
            values[off] += 0.03 * (s.max - s.min);
            return values;
        };
        for (const auto& measure : {measure_lookups, measure_voxels}) {
            const ErrorFigures errors =
                measure(level, PixelType::float32, reference, 100, {}, {}).figures;
            EXPECT_NEAR(errors.max, 0.03, 1e-6) << off;
            EXPECT_NEAR(errors.rms, 0.03 / std::sqrt(3.0), 1e-6) << off;
        }
    }
}

// The reference is asked in the middle of an axis of one voxel, and all over other axes.
TEST(CertifyVolume, FlatAxesAreMeasuredInTheirMiddle) {
    for (std::size_t flat = 0; flat < 3; ++flat) {
        std::array<int, 3> size = {5, 6, 7};
        size[flat] = 1;
        const Level level = level_of(size, 1, PixelType::float32, sample_voxel);
        const auto reference = [&](const Point& uvw) {
            return std::vector<double>{
                looked_up(sample_voxel, size, PixelType::float32, 0, uvw) +
                (std::fabs(uvw[flat] - 0.5) + (uvw[(flat + 1) % 3] > 0.9 ? 0.5 : 0))};
        };
        const VolumeErrors errors =
            measure_lookups(level, PixelType::float32, reference, 300, {.threads = 1});
        const double range = level.statistics[0].max - level.statistics[0].min;
        EXPECT_NEAR(errors.figures.max, 0.5 / range, 1e-6);
        EXPECT_EQ(errors.worst[flat], 0.5);
        EXPECT_GT(errors.worst[(flat + 1) % 3], 0.9);
        EXPECT_NEAR(errors.figures.rms, 0.5 / range * std::sqrt(0.1), 0.01 / range);
    }
}

TEST(CertifyVolume, NamesTheWorstPlaceAndAsksInTextureCoordinates) {
    const std::array<int, 3> size = {5, 7, 9};
    const Level level = level_of(size, 3, PixelType::half, sample_voxel);
    const auto reference = [](const Point& uvw) {
        return std::vector<double>{uvw[0] + uvw[1] * uvw[2], uvw[2], uvw[0]};
    };
    BakeOptions two_threads;
    two_threads.threads = 2;
    const VolumeErrors errors =
        measure_lookups(level, PixelType::half, reference, 500, two_threads);
    double worst = 0;
    for (int c = 0; c < 3; ++c) {
        const auto channel = static_cast<std::size_t>(c);
        const double range = level.statistics[channel].max - level.statistics[channel].min;
        const double found = looked_up(sample_voxel, size, PixelType::half, c, errors.worst);
        worst = std::max(worst, std::fabs(found - reference(errors.worst)[channel]) / range);
    }
    EXPECT_NEAR(errors.figures.max, worst, 1e-12);
    BakeOptions one_thread;
    one_thread.threads = 1;
    const VolumeErrors again = measure_lookups(level, PixelType::half, reference, 500, one_thread);
    EXPECT_EQ(again.figures.max, errors.figures.max);
    EXPECT_EQ(again.figures.rms, errors.figures.rms);
    EXPECT_EQ(again.worst, errors.worst);
}

// Errors of a third of their noise, as paths of light would measure them, with noise of every size.
TEST(ErrorStatistics, TakeOffTheNoiseOfTheReference) {
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    ErrorStatistics with_noise, plain, only_noise;
    for (int i = 0; i < 20000; ++i) {
        const double noise = 0.01 * (1 + i % 5);
        const double error = noise / 3 * normal(random);
        plain.add(error);
        with_noise.add(error + noise * normal(random), noise);
        only_noise.add(noise * normal(random), noise);
    }
    EXPECT_NEAR(with_noise.figures().rms, plain.figures().rms, 0.1 * plain.figures().rms);
    EXPECT_LT(with_noise.figures().max, 0.2);
    // The sum of 20000 squares is known to sqrt(2 / 20000), so that less than a tenth of the noise is unseen.
    EXPECT_GT(only_noise.figures().rms, 0.001);
    EXPECT_LT(only_noise.figures().rms, 0.01);
    with_noise.add(std::nan(""), 0.01);
    EXPECT_TRUE(std::isnan(with_noise.figures().max));
    EXPECT_TRUE(std::isnan(with_noise.figures().rms));
}

}  // namespace
}  // namespace skybake
