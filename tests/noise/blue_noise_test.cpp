// The asset blue_noise: its values, its figures and its probes.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <random>

#include "bakers/assets/blue_noise/blue_noise_volume.h"
#include "bakers/assets/blue_noise/mask_figures.h"
#include "bakers/field/baked.h"
#include "config/assets/blue_noise.h"
#include "tests/support/outcomes.h"
#include "tests/support/volumes.h"

namespace skybake {
namespace {

config::BlueNoiseBake bake_of(const std::array<int, 2>& size, int frames, PixelType type) {
    config::BlueNoiseBake bake;
    bake.size = size;
    bake.frames = frames;
    bake.spatial_sigma = bake.temporal_sigma = 1.9;
    bake.pixel_type = type;
    bake.formats = {config::FileFormat::bin};
    bake.mips = 1;
    return bake;
}

Baked baked(const config::BlueNoiseBake& bake) {
    return test::without_diagnostics(bake_blue_noise(bake, {}, {}));
}

// How often the ranks of a frame have each code.
std::vector<int> counts_of(std::size_t pixels, PixelType type, double most) {
    std::vector<int> counts(static_cast<std::size_t>(most) + 1);
    for (std::size_t rank = 0; rank < pixels; ++rank) {
        const float value = mask_value(static_cast<std::uint32_t>(rank), pixels, type);
        ++counts.at(static_cast<std::size_t>(std::lround(double{value} * most)));
    }
    return counts;
}

// The law of a uniform histogram, for frames of any number of pixels.
RC_GTEST_PROP(BlueNoise, EveryCodeIsAsFrequentAsAnyOtherButForOnePixel, ()) {
    const auto pixels = static_cast<std::size_t>(*rc::gen::inRange(1, 100000));
    for (const auto& [type, most] :
         {std::pair{PixelType::unorm8, 255.0}, std::pair{PixelType::unorm16, 65535.0}}) {
        const std::vector<int> counts = counts_of(pixels, type, most);
        const auto [least, greatest] = std::minmax_element(counts.begin(), counts.end());
        RC_ASSERT(*greatest - *least <= 1);
    }
}

TEST(BlueNoise, FramesOf256MultiplesHaveEachByteEquallyOften) {
    const Baked volume = baked(bake_of({32, 16}, 3, PixelType::unorm8));
    const std::vector<float> values = testing::voxels_of(volume, 0);
    for (std::size_t frame = 0; frame < 3; ++frame) {
        std::vector<int> counts(256);
        for (std::size_t i = 0; i < 512; ++i) {
            ++counts.at(
                static_cast<std::size_t>(std::lround(255 * double{values[frame * 512 + i]})));
        }
        EXPECT_EQ(counts, std::vector<int>(256, 2)) << frame;
    }
}

TEST(BlueNoise, OtherTypesHaveTheMiddlesOfEqualParts) {
    EXPECT_EQ(mask_value(0, 8, PixelType::float32), 0.0625F);
    EXPECT_EQ(mask_value(7, 8, PixelType::float32), 0.9375F);
    const Baked volume = baked(bake_of({12, 10}, 2, PixelType::float32));
    EXPECT_LT(volume.certificate.texel.max, 1e-7);
    // A code of unorm8 stands for 1/256, and its number goes from 0 to 255 in steps of 1/255.
    EXPECT_NEAR(baked(bake_of({64, 64}, 1, PixelType::unorm8)).certificate.texel.max, 1 / 256.0,
                2e-4);
}

// The smallest masks, which have no low frequencies and no window of 8 x 8 pixels.
TEST(BlueNoise, TinyMasksHaveTheirProbesAndFigures) {
    for (const std::array<int, 2>& size : {std::array{2, 2}, {3, 2}, {2, 7}}) {
        const Baked volume = baked(bake_of(size, 1, PixelType::float32));
        EXPECT_LT(volume.certificate.texel.max, 1e-7);
        EXPECT_FALSE(volume.levels.front().probes.empty());
        for (const char* name : {"low_power_of_frames", "low_power_over_time"}) {
            EXPECT_EQ(fact_named(volume.details, name), "0") << name;
        }
    }
}

TEST(BlueNoise, SaysWhatItIs) {
    const Baked volume = baked(bake_of({24, 20}, 5, PixelType::unorm8));
    EXPECT_EQ(volume.kind, "blue_noise");
    EXPECT_EQ(volume.channel_names, std::vector<std::string>{"Y"});
    EXPECT_EQ(volume.levels.front().size, (std::array<int, 3>{24, 20, 5}));
    EXPECT_TRUE(volume.levels.front().nearest);
    EXPECT_TRUE(volume.certified);
    EXPECT_GE(volume.levels.front().probes.size(), 16U);
    for (const Probe& probe : volume.levels.front().probes) {
        for (std::size_t i = 0; i < 3; ++i) {
            // A quarter of a voxel from its middle: no rounding reaches the next one.
            const double part = std::fmod(probe.at[i].second, 1);
            EXPECT_TRUE(part == 0.25 || part == 0.75) << part;
            EXPECT_NEAR(probe.uvw[i], probe.at[i].second / volume.levels.front().size[i], 1e-12);
        }
    }
}

// Means of windows of 8 x 8 pixels are off 1/2 by an RMS of 0.036 in white noise, and by a third of
// that, 0.0115, in blue noise: what is left comes from the windows' edges.
TEST(BlueNoise, MeansOfWindowsAreMuchNearerToOneHalfThanThoseOfWhiteNoise) {
    const Baked volume = baked(bake_of({64, 64}, 4, PixelType::float32));
    EXPECT_LT(volume.certificate.lookup.rms, 0.036 / 2.5);
    EXPECT_GE(volume.certificate.lookup.max, volume.certificate.lookup.rms);
    std::mt19937 engine(1);
    std::vector<float> white(64 * 64 * 4);
    for (float& value : white) value = static_cast<float>(engine() >> 8) * 0x1p-24F;
    EXPECT_NEAR(window_error({{64, 64, 4}, &white}).rms, 0.036, 0.004);
}

// Means and spectra by their definitions, of values that have no structure.
TEST(MaskFigures, AreTheirDefinitions) {
    const std::array<int, 3> size = {18, 17, 17};
    std::mt19937 engine(2);
    std::vector<float> values(18 * 17 * 17);
    for (float& value : values) value = static_cast<float>(engine() >> 8) * 0x1p-24F;
    const MaskView mask{size, &values};
    double low = 0, all = 0, low_count = 0, all_count = 0;
    double low_t = 0, all_t = 0, low_t_count = 0, all_t_count = 0;
    const double tau = 2 * std::numbers::pi;
    for (int k = 0; k < 18; ++k) {
        for (int l = 0; l < 17; ++l) {
            if (k == 0 && l == 0) continue;
            const double u = std::min(k, 18 - k) / 18.0, v = std::min(l, 17 - l) / 17.0;
            for (int t = 0; t < 17; ++t) {
                std::complex<double> sum = 0;
                for (int i = 0; i < 18 * 17; ++i) {
                    const double turns = k * (i % 18) / 18.0 + l * (i / 18) / 17.0;
                    sum += double{values[static_cast<std::size_t>(t * 18 * 17 + i)]} *
                           std::polar(1.0, -tau * turns);
                }
                all += std::norm(sum);
                ++all_count;
                if (std::hypot(u, v) >= 0.125) continue;
                low += std::norm(sum);
                ++low_count;
            }
        }
    }
    for (int k = 1; k < 17; ++k) {
        for (int i = 0; i < 18 * 17; ++i) {
            std::complex<double> sum = 0;
            for (int t = 0; t < 17; ++t) {
                sum += double{values[static_cast<std::size_t>(t * 18 * 17 + i)]} *
                       std::polar(1.0, -tau * k * t / 17.0);
            }
            all_t += std::norm(sum);
            ++all_t_count;
            if (std::min(k, 17 - k) / 17.0 >= 0.125) continue;
            low_t += std::norm(sum);
            ++low_t_count;
        }
    }
    EXPECT_NEAR(low_power_of_frames(mask), low / low_count / (all / all_count), 1e-6);
    EXPECT_NEAR(low_power_over_time(mask), low_t / low_t_count / (all_t / all_t_count), 1e-6);
}

TEST(MaskFigures, AreZeroWhereThereIsNothingToMeasure) {
    const std::vector<float> same(64, 0.5F);
    EXPECT_EQ(low_power_of_frames({{8, 8, 1}, &same}), 0);
    EXPECT_EQ(low_power_over_time({{8, 8, 1}, &same}), 0);
    EXPECT_EQ(window_error({{8, 8, 1}, &same}).max, 0);
}

}  // namespace
}  // namespace skybake
