#include "bakers/report/sweeps/noise_volume_sweep.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "config/assets/noise_volume.h"
#include "config/recipe/recipe.h"

namespace skybake {
namespace {

using config::Noise;
using config::NoiseVolumeBake;
using config::PixelType;
using Size = std::array<int, 3>;

// The noise with these channels.
Noise noise_of(const std::string& channels) {
    const auto recipe = config::parse_recipe("[noise.n]\n" + channels + "\n", "recipe");
    EXPECT_TRUE(recipe.value) << channels;
    return recipe.value ? recipe.value->parameters.noises.at(0) : Noise{};
}

NoiseVolumeBake bake_of(Size size) {
    NoiseVolumeBake bake;
    bake.noise = "n";
    bake.size = size;
    bake.formats = {config::FileFormat::exr};
    return bake;
}

std::set<Size> sizes_in(const VolumeSweep& sweep) {
    std::set<Size> sizes;
    for (const VolumeVariant& variant : sweep.variants) sizes.insert(variant.size);
    return sizes;
}

long count_of_recipe(const VolumeSweep& sweep) {
    return std::count_if(sweep.variants.begin(), sweep.variants.end(),
                         [](const VolumeVariant& variant) { return variant.of_recipe; });
}

const char* const kPerlin =
    "channels.Y = {type = 'perlin', frequency = 2, octaves = 3, gain = 0.5}";

TEST(NoiseVolumeSweep, HasSizesAboutTheBakesOwn) {
    const Noise noise = noise_of(kPerlin);
    const VolumeSweep sweep = noise_volume_sweep(noise, bake_of({32, 32, 16}), {32, 32, 16}, true);
    EXPECT_EQ(
        sizes_in(sweep),
        (std::set<Size>{{16, 16, 8}, {24, 24, 12}, {32, 32, 16}, {48, 48, 24}, {64, 64, 32}}));
    EXPECT_TRUE(sweep.notes.empty());
}

TEST(NoiseVolumeSweep, IsOfNoMoreVoxelsThanCanBeHeld) {
    const Noise one = noise_of(kPerlin);
    const Noise four = noise_of("preset = 'nubis_shape'");
    const Noise packed = noise_of("preset = 'takram_shape'");
    EXPECT_EQ(report_size(four, bake_of({128, 128, 128}), true), (Size{128, 128, 128}));
    EXPECT_EQ(report_size(four, bake_of({129, 128, 128}), true), (Size{64, 64, 64}));
    EXPECT_EQ(report_size(one, bake_of({1024, 1024, 1024}), true), (Size{128, 128, 128}));
    EXPECT_EQ(report_size(packed, bake_of({256, 256, 256}), false), (Size{256, 256, 256}));
    EXPECT_EQ(report_size(four, bake_of({512, 512, 64}), false), (Size{512, 512, 64}));
    const VolumeSweep sweep =
        noise_volume_sweep(four, bake_of({128, 128, 128}), {128, 128, 128}, true);
    EXPECT_EQ(*sizes_in(sweep).rbegin(), (Size{128, 128, 128}));
}

TEST(NoiseVolumeSweep, MarksNothingAsTheRecipesWhereItIsSmaller) {
    const Noise noise = noise_of(kPerlin);
    EXPECT_EQ(count_of_recipe(noise_volume_sweep(noise, bake_of({16, 16, 16}), {16, 16, 16}, true)),
              1);
    EXPECT_EQ(count_of_recipe(noise_volume_sweep(noise, bake_of({32, 32, 32}), {16, 16, 16}, true)),
              0);
}

// EXR and VDB hold no unorm: the recipe's own is bin, the others are shown as half.
TEST(NoiseVolumeSweep, StoresUnormInBinAlone) {
    const Noise noise = noise_of(kPerlin);
    NoiseVolumeBake bake = bake_of({16, 16, 16});
    bake.formats = {config::FileFormat::bin};
    bake.pixel_type = PixelType::unorm8;
    const VolumeSweep sweep = noise_volume_sweep(noise, bake, bake.size, true);
    EXPECT_EQ(count_of_recipe(sweep), 1);
    for (const VolumeVariant& variant : sweep.variants) {
        if (variant.format == config::FileFormat::exr ||
            variant.format == config::FileFormat::vdb) {
            EXPECT_EQ(variant.pixel_type, PixelType::half) << variant.name;
        }
        if (variant.of_recipe) {
            EXPECT_EQ(variant.pixel_type, PixelType::unorm8);
        }
    }
}

// 16 cells on 8 voxels: two cells from centre to centre.
TEST(NoiseVolumeSweep, SizesThatBakeRefusesAreLeftOutWithANote) {
    const Noise noise =
        noise_of("channels.Y = {type = 'perlin', frequencies = [2, 16], gain = 0.5}");
    const VolumeSweep sweep = noise_volume_sweep(noise, bake_of({16, 16, 16}), {16, 16, 16}, true);
    EXPECT_EQ(sizes_in(sweep).count({8, 8, 8}), 0u);
    EXPECT_EQ(sizes_in(sweep).count({12, 12, 12}), 1u);
    ASSERT_EQ(sweep.notes.size(), 1u);
    EXPECT_NE(sweep.notes[0].find("8x8x8"), std::string::npos);
}

TEST(NoiseVolumeSweep, OctavesWithoutWeightAreLeftOutWithANote) {
    const Noise noise =
        noise_of("channels.Y = {type = 'perlin', frequency = 2, gains = [0, 1, 1]}");
    const VolumeSweep sweep = noise_volume_sweep(noise, bake_of({16, 16, 16}), {16, 16, 16}, true);
    std::set<std::string> names;
    for (const VolumeVariant& variant : sweep.variants) names.insert(variant.name);
    EXPECT_EQ(names.count("1 of 3 octaves"), 0u);
    EXPECT_EQ(names.count("2 of 3 octaves"), 1u);
    ASSERT_EQ(sweep.notes.size(), 1u);
    EXPECT_NE(sweep.notes[0].find("1 of 3 octaves"), std::string::npos);
}

}  // namespace
}  // namespace skybake
