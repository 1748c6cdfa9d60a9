// The asset: what bake_noise_volume says of its voxels.
#include "bakers/assets/noise_volume/noise_volume.h"

#include <gtest/gtest.h>

#include "bakers/field/certify.h"
#include "config/assets/noise_volume.h"
#include "tests/noise/noises.h"
#include "tests/support/outcomes.h"
#include "tests/support/refused.h"

namespace skybake {
namespace {

using config::NoiseSampling;

config::Noise cloud_shape() {
    return test::picture_of(
        {test::channel_of(config::NoiseType::perlin_worley, {{3, 3, 3}, {6, 6, 6}}),
         test::worley({{4, 4, 4}, {8, 8, 8}}, config::WorleyFeature::f1,
                      config::WorleyValue::one_minus_distance),
         test::worley({{8, 8, 8}}, config::WorleyFeature::f1,
                      config::WorleyValue::one_minus_distance)});
}

config::NoiseVolumeBake bake_of(const std::array<int, 3>& size, int mips = 1) {
    config::NoiseVolumeBake bake;
    bake.noise = "n";
    bake.size = size;
    bake.formats = {config::FileFormat::exr};
    bake.mips = mips;
    return bake;
}

Baked baked(const config::Noise& noise, const config::NoiseVolumeBake& bake,
            const BakeOptions& options = {}) {
    return test::without_diagnostics(bake_noise_volume(noise, bake, options, {}));
}

TEST(NoiseVolume, DescribesItsVoxels) {
    const Baked volume = baked(cloud_shape(), bake_of({32, 24, 16}, 3));
    EXPECT_EQ(volume.kind, "noise_volume");
    EXPECT_EQ(volume.channel_names, (std::vector<std::string>{"R", "G", "B"}));
    EXPECT_EQ(volume.seam_error, 0);
    ASSERT_EQ(volume.levels.size(), 3u);
    EXPECT_EQ(volume.levels[1].size, (std::array<int, 3>{16, 12, 8}));
    EXPECT_EQ(volume.levels[2].size, (std::array<int, 3>{8, 6, 4}));
    for (const Level& level : volume.levels) {
        ASSERT_EQ(level.statistics.size(), 3u);
        EXPECT_FALSE(level.content_hash.empty());
        EXPECT_FALSE(level.probes.empty());
        for (std::size_t c = 0; c < 3; ++c) {
            // Mips are rounded one by one: half a step of a half near 1 each.
            EXPECT_NEAR(level.statistics[c].mean, volume.levels[0].statistics[c].mean, 0x1p-11);
            EXPECT_LE(level.statistics[c].min, level.statistics[c].mean);
            EXPECT_GE(level.statistics[c].max, level.statistics[c].mean);
        }
    }
    // Octave 8 of G and B is one.
    ASSERT_FALSE(volume.details.empty());
    EXPECT_EQ(volume.details[0], (Facts::value_type{"distinct_octaves", 6.0}));
}

TEST(NoiseVolume, CertifiesTexelsAndLookups) {
    const Baked coarse = baked(cloud_shape(), bake_of({16, 16, 16}));
    const Baked fine = baked(cloud_shape(), bake_of({64, 64, 64}));
    for (const Baked* volume : {&coarse, &fine}) {
        EXPECT_TRUE(volume->certified);
        const Certificate& certificate = volume->certificate;
        // Voxels are as good as halves, of values up to 1, are.
        double least_range = 1;
        for (const ValueStatistics& s : volume->levels[0].statistics) {
            least_range = std::min(least_range, s.max - s.min);
        }
        EXPECT_GT(certificate.texel.max, 0);
        EXPECT_LE(certificate.texel.max, (0x1p-12 + 1e-6) / least_range);
        EXPECT_GT(certificate.lookup.max, certificate.texel.max);
    }
    EXPECT_LT(fine.certificate.lookup.rms, coarse.certificate.lookup.rms / 2);
}

// Corners move the mapping, not the error: a lookup at a voxel's texture coordinates is the voxel.
TEST(NoiseVolume, MapsCornersByHalfAVoxel) {
    for (const auto sampling :
         {NoiseSampling::centers, NoiseSampling::corners, NoiseSampling::slices_at_corners}) {
        config::Noise noise = cloud_shape();
        noise.sampling = sampling;
        const Baked volume = baked(noise, bake_of({20, 12, 28}));
        EXPECT_LE(volume.certificate.texel.max, 0.001);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const bool centered = sampling == NoiseSampling::centers ||
                                  (sampling == NoiseSampling::slices_at_corners && axis < 2);
            EXPECT_EQ(volume.axes[axis].formula.find(" + 1 / (2 * ") == std::string::npos,
                      centered);
        }
    }
}

TEST(NoiseVolume, DoesNotDependOnThreads) {
    const Baked a = baked(cloud_shape(), bake_of({33, 20, 41}, 4), {.threads = 1});
    const Baked b = baked(cloud_shape(), bake_of({33, 20, 41}, 4), {.threads = 2});
    ASSERT_EQ(a.levels.size(), b.levels.size());
    for (std::size_t i = 0; i < a.levels.size(); ++i) {
        EXPECT_EQ(a.levels[i].content_hash, b.levels[i].content_hash);
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_EQ(a.levels[i].statistics[c].mean, b.levels[i].statistics[c].mean);
            EXPECT_EQ(a.levels[i].statistics[c].histogram, b.levels[i].statistics[c].histogram);
        }
    }
    EXPECT_EQ(a.certificate.lookup.max, b.certificate.lookup.max);
    EXPECT_EQ(a.certificate.lookup.rms, b.certificate.lookup.rms);
    EXPECT_EQ(a.certificate.worst, b.certificate.worst);
}

TEST(NoiseVolume, RefusesWhatThePixelTypeCannotHold) {
    config::Noise noise = test::noise_of({test::curl({{4, 4, 4}}, config::CurlComponent::x)});
    config::NoiseVolumeBake bake = bake_of({16, 16, 16});
    bake.pixel_type = PixelType::unorm8;  // and values below 0
    test::expect_refused(bake_noise_volume(noise, bake, {}, {}), "E0402");
}

// The low clouds of takram's weather map: Worley octaves of amplitudes 0.4 times powers of 0.95,
// which add up to as much as 1.484, through smoothstep(0.8, 1.4).
config::Noise takram_weather() {
    config::NoiseChannel channel =
        test::worley({{16, 16, 1}, {32, 32, 1}, {64, 64, 1}, {128, 128, 1}});
    channel.octaves.gains = {1, 0.95, 0.9025, 0.857375};
    channel.value_form = config::WorleyValue::one_minus_distance_squared;
    channel.remap = {0, 1, 0, 0.4 * (1 + 0.95 + 0.9025 + 0.857375)};
    return test::noise_of({channel});
}

TEST(NoiseVolume, WeatherAsBytesTakesAStep) {
    config::Noise weather = takram_weather();
    config::NoiseVolumeBake bake = bake_of({64, 64, 1});
    bake.formats = {config::FileFormat::bin};
    bake.pixel_type = PixelType::unorm8;
    const auto refused = test::expect_refused(bake_noise_volume(weather, bake, {}, {}), "E0402");
    EXPECT_NE(refused.label.find("smoothstep or clamp"), std::string::npos);

    weather.channels[0].smoothstep = {0.8, 1.4};
    const Baked stepped = baked(weather, bake);
    EXPECT_EQ(stepped.levels[0].statistics[0].min, 0);
    EXPECT_GT(stepped.levels[0].statistics[0].max, 0.5);

    weather.channels[0].smoothstep.reset();
    weather.channels[0].clamp = {0, 1};
    const Baked clamped = baked(weather, bake);
    EXPECT_EQ(clamped.levels[0].statistics[0].max, 1);
}

TEST(NoiseVolume, PacksIntoOneChannelY) {
    config::Noise noise = cloud_shape();
    noise.pack = config::NoisePacking::detail;
    const Baked volume = baked(noise, bake_of({16, 16, 16}, 2));
    EXPECT_EQ(volume.channel_names, std::vector<std::string>{"Y"});
    for (const Level& level : volume.levels) EXPECT_EQ(level.statistics.size(), 1u);
    EXPECT_EQ(volume.levels[0].probes[0].value.size(), 1u);
}

}  // namespace
}  // namespace skybake
