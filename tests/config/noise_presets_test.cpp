// The noise presets, number by number.
#include <gtest/gtest.h>

#include "config/assets/noise_volume.h"
#include "config/presets/presets.h"
#include "config/sections/noise.h"
#include "tests/config/noises.h"

namespace skybake::config {
namespace {

Noise preset(const std::string& name) {
    const Recipe recipe = testing::valid("[noise.n]\npreset = '" + name + "'\n");
    return recipe.parameters.noises.empty() ? Noise{} : recipe.parameters.noises[0];
}

NoiseOctaves octaves(std::vector<int> frequencies, std::vector<double> gains) {
    NoiseOctaves result{{}, std::move(gains)};
    for (const int f : frequencies) result.frequencies.push_back({f, f, f});
    return result;
}

void expect_octaves(const NoiseOctaves& found, const NoiseOctaves& expected) {
    EXPECT_EQ(found.frequencies, expected.frequencies);
    EXPECT_EQ(found.gains, expected.gains);
}

void expect_worley(const NoiseChannel& channel, const NoiseOctaves& expected, WorleyValue form) {
    EXPECT_EQ(channel.type, NoiseType::worley) << channel.name;
    EXPECT_EQ(channel.feature, WorleyFeature::f1) << channel.name;
    EXPECT_EQ(channel.value_form, form) << channel.name;
    expect_octaves(channel.octaves, expected);
}

const std::vector<double> cloud_gains = {0.625, 0.25, 0.125};
const std::vector<double> half_gains = {1, 0.5, 0.25, 0.125, 0.0625};
constexpr WorleyValue squared = WorleyValue::one_minus_distance_squared;
constexpr WorleyValue over_sqrt3 = WorleyValue::one_minus_distance_over_sqrt3;
using Size = std::array<int, 3>;

// What the shapes of Nubis' and takram's clouds share: Perlin-Worley noise, then Worley noises.
void expect_shape(const Noise& noise, const std::array<std::vector<int>, 4>& worley) {
    EXPECT_EQ(noise.size, (Size{128, 128, 128}));
    ASSERT_EQ(noise.channels.size(), 4u);
    const NoiseChannel& red = noise.channels[0];
    EXPECT_EQ(red.type, NoiseType::perlin_worley);
    EXPECT_EQ(red.fractal, NoiseFractal::rectified);
    EXPECT_EQ(red.value_form, squared);
    expect_octaves(red.octaves, octaves({8, 16, 32}, {1, 0.5, 0.25}));
    expect_octaves(red.worley_octaves, octaves(worley[0], cloud_gains));
    expect_worley(noise.channels[1], octaves(worley[1], cloud_gains), squared);
    expect_worley(noise.channels[2], octaves(worley[2], cloud_gains), squared);
    expect_worley(noise.channels[3], octaves(worley[3], {0.75, 0.25}), squared);
}

TEST(NoisePresets, Shapes) {
    const Noise nubis = preset("nubis_shape");
    EXPECT_EQ(nubis.sampling, NoiseSampling::centers);
    EXPECT_EQ(nubis.pack, NoisePacking::none);
    expect_shape(nubis, {{{4, 8, 16}, {4, 8, 16}, {8, 16, 32}, {16, 32}}});
    const Noise takram = preset("takram_shape");
    EXPECT_EQ(takram.sampling, NoiseSampling::slices_at_corners);
    EXPECT_EQ(takram.pack, NoisePacking::shape);
    expect_shape(takram, {{{8, 32, 56}, {8, 16, 32}, {16, 32, 64}, {32, 64}}});
}

TEST(NoisePresets, Details) {
    const Noise nubis = preset("nubis_detail");
    EXPECT_EQ(nubis.sampling, NoiseSampling::centers);
    const Noise takram = preset("takram_detail");
    EXPECT_EQ(takram.sampling, NoiseSampling::slices_at_corners);
    EXPECT_EQ(takram.pack, NoisePacking::detail);
    for (const Noise& noise : {nubis, takram}) {
        EXPECT_EQ(noise.size, (Size{32, 32, 32}));
        ASSERT_EQ(noise.channels.size(), 3u);
        expect_worley(noise.channels[0], octaves({2, 4, 8}, cloud_gains), squared);
    }
    expect_worley(nubis.channels[1], octaves({4, 8}, {0.75, 0.25}), squared);
    expect_worley(nubis.channels[2], octaves({8}, {1}), squared);
    expect_worley(takram.channels[1], octaves({4, 8, 16}, cloud_gains), squared);
    expect_worley(takram.channels[2], octaves({8, 16}, {0.75, 0.25}), squared);
}

TEST(NoisePresets, Thesis) {
    const Noise noise = preset("thesis");
    EXPECT_EQ(noise.size, (Size{128, 128, 128}));
    EXPECT_EQ(noise.sampling, NoiseSampling::corners);
    ASSERT_EQ(noise.channels.size(), 4u);
    expect_worley(noise.channels[0], octaves({4, 8, 16, 32, 64}, half_gains), over_sqrt3);
    EXPECT_EQ(noise.channels[1].type, NoiseType::perlin);
    EXPECT_EQ(noise.channels[1].fractal, NoiseFractal::fbm);
    expect_octaves(noise.channels[1].octaves, octaves({4, 8, 16, 32, 64}, half_gains));
    expect_worley(noise.channels[2], octaves({16, 32, 64, 128, 256}, half_gains), over_sqrt3);
    expect_worley(noise.channels[3], octaves({128, 256, 512, 1024, 2048}, half_gains), over_sqrt3);
}

TEST(NoisePresets, TheExampleIsWithoutFault) {
    const auto outcome = load_recipe(SKYBAKE_EXAMPLES "/clouds_noise.toml");
    EXPECT_TRUE(outcome.diagnostics.empty());
    ASSERT_TRUE(outcome.value);
    const Parameters& parameters = outcome.value->parameters;
    ASSERT_EQ(parameters.bakes.size(), 2u);
    const auto& shape = parameters.bakes[0].as<NoiseVolumeBake>();
    const auto& detail = parameters.bakes[1].as<NoiseVolumeBake>();
    EXPECT_EQ(testing::to_string(shape), "shape [128, 128, 128] 1 0 0 1 1 2 0");
    EXPECT_EQ(testing::to_string(detail), "detail [32, 32, 32] 1 0 0 1 1 2 0");
}

// Presets that copy a source which aliases say so in their keys, not in a warning.
TEST(NoisePresets, BakeAtTheirSize) {
    for (const Preset& entry : noise_presets()) {
        const auto outcome = testing::parse("[noise.n]\npreset = '" + std::string(entry.name) +
                                            "'\n[bake.n]\nasset = 'noise_volume'\nnoise = 'n'\n");
        ASSERT_TRUE(outcome.value) << entry.name;
        const auto& bake = outcome.value->parameters.bakes.at(0).as<NoiseVolumeBake>();
        EXPECT_EQ(bake.size, outcome.value->parameters.noises.at(0).size);
        EXPECT_TRUE(outcome.diagnostics.empty()) << entry.name;
    }
}

}  // namespace
}  // namespace skybake::config
