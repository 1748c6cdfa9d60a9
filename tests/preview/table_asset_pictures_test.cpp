// Pictures of phase functions and of Bruneton's tables.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <functional>
#include <numbers>
#include <string>

#include "bakers/preview/pictures/asset_pictures.h"
#include "tests/support/comparisons.h"
#include "tests/support/loops.h"

namespace skybake {

namespace {

bool has_two_colours(const Picture& picture) {
    return std::any_of(picture.rgb.begin(), picture.rgb.end(),
                       [&](std::uint8_t value) { return value != picture.rgb.front(); });
}

PreviewAsset phase_asset(const std::string& mapping) {
    PreviewAsset asset;
    asset.entry.name = "drops";
    asset.entry.kind = "phase";
    asset.entry.mapping = mapping;
    asset.entry.channels = {"R", "G", "B"};
    asset.entry.size = {64, 1};
    asset.table = Image2<float>(64, 1, 3);
    for (int i = 0; i < 64; ++i) {
        for (int c = 0; c < 3; ++c) {
            asset.table.texel(i, 0)[c] = 2.0f / static_cast<float>(1 + i + c);
        }
    }
    return asset;
}

TEST(PhasePictures, ShowTheFunctionAndItsPeak) {
    for (const char* mapping : {"angle", "cosine", "peaks", "cosine_from_back"}) {
        const auto pictures = phase_pictures(phase_asset(mapping));
        ASSERT_EQ(pictures.size(), 2u) << mapping;
        EXPECT_NE(pictures[0].name, pictures[1].name);
        for (const PreviewPicture& picture : pictures) {
            EXPECT_TRUE(has_two_colours(picture.picture)) << picture.name;
        }
    }
    EXPECT_EQ(phase_pictures(phase_asset("share")).size(), 1u);
}

// Returns the largest difference between two pictures of the same size.
// A curve that is drawn from its other end differs in a few shades along its edges; on a wrong axis it
// stands elsewhere.
TEST(PhasePictures, ShowTheSameCurveFromEitherEnd) {
    PreviewAsset forward = phase_asset("cosine"), backward = phase_asset("cosine_from_back");
    for (int i = 0; i < 64; ++i) {
        std::copy_n(forward.table.texel(63 - i, 0), 3, backward.table.texel(i, 0));
    }
    PreviewAsset wrong = backward;
    wrong.entry.mapping = "peaks";
    const auto seen = phase_pictures(forward), turned = phase_pictures(backward);
    const auto moved = phase_pictures(wrong);
    ASSERT_EQ(turned.size(), seen.size());
    for (std::size_t i = 0; i < seen.size(); ++i) {
        EXPECT_LE(test::largest_difference(turned[i].picture.rgb, seen[i].picture.rgb), 8)
            << seen[i].name;
        EXPECT_GT(test::largest_difference(moved[i].picture.rgb, seen[i].picture.rgb), 100)
            << seen[i].name;
    }
}

TEST(PhasePictures, OfAnUnknownSpacingAreNone) {
    EXPECT_TRUE(phase_pictures(phase_asset("by_moonlight")).empty());
}

PreviewAsset scattering_asset(int channels, int depth) {
    PreviewAsset asset;
    asset.entry.name = "scattering";
    asset.entry.kind = "bruneton";
    asset.entry.channels.assign(static_cast<std::size_t>(channels), "C");
    asset.entry.size = {16, 8, depth};
    for (int i = 0; i < 16 * 8 * depth * channels; ++i) {
        asset.voxels.push_back(0.01f * static_cast<float>(i % 97));
    }
    return asset;
}

TEST(BrunetonPictures, ShowColoursAndMieApart) {
    EXPECT_EQ(bruneton_pictures(scattering_asset(3, 6)).size(), 1u);
    const auto combined = bruneton_pictures(scattering_asset(4, 6));
    ASSERT_EQ(combined.size(), 2u);
    EXPECT_NE(combined[0].name, combined[1].name);
    const auto flat = bruneton_pictures(scattering_asset(1, 1));
    ASSERT_EQ(flat.size(), 1u);
    EXPECT_LT(flat[0].picture.height, combined[0].picture.height);
    for (const PreviewPicture& picture : combined) EXPECT_TRUE(has_two_colours(picture.picture));
}

TEST(BrunetonPictures, OfATruncatedFileAreNone) {
    PreviewAsset asset = scattering_asset(4, 6);
    asset.voxels.pop_back();
    EXPECT_TRUE(bruneton_pictures(asset).empty());
}

// Pictures of weather maps and of blue noise.

constexpr double tau = 2 * std::numbers::pi;

PreviewAsset mask_of(const std::array<int, 3>& size,
                     const std::function<double(int x, int y, int t)>& value) {
    PreviewAsset asset;
    asset.entry.name = "mask";
    asset.entry.kind = "blue_noise";
    asset.entry.size = {size[0], size[1], size[2]};
    asset.entry.axes.resize(3);
    asset.entry.channels = {"Y"};
    testing::for_each_voxel(size, [&](int x, int y, int t) {
        asset.voxels.push_back(static_cast<float>(value(x, y, t)));
    });
    return asset;
}

std::vector<std::string> names_of(const std::vector<PreviewPicture>& pictures) {
    std::vector<std::string> names;
    for (const PreviewPicture& picture : pictures) names.push_back(picture.name);
    return names;
}

// The brightest pixels of a picture, in units of its scale, from the middle and with y up.
std::vector<std::array<int, 2>> waves_of(const Picture& picture, int scale) {
    std::vector<std::array<int, 2>> waves;
    for (int y = scale / 2; y < picture.height; y += scale) {
        for (int x = scale / 2; x < picture.width; x += scale) {
            if (picture.rgb[3 * static_cast<std::size_t>(y * picture.width + x)] < 255) continue;
            waves.push_back({x / scale - picture.width / scale / 2,
                             (picture.height - 1 - y) / scale - picture.height / scale / 2});
        }
    }
    return waves;
}

// A wave and its mirror image are all that its spectrum shows.
TEST(BlueNoisePictures, PowerShowsAWaveAtItsFrequency) {
    const PreviewAsset asset = mask_of({32, 32, 4}, [](int x, int y, int) {
        return 0.5 + 0.5 * std::cos(tau * (5 * x - 3 * y) / 32.0);
    });
    const std::vector<PreviewPicture> pictures = blue_noise_pictures(asset);
    ASSERT_EQ(names_of(pictures),
              (std::vector<std::string>{"mask_frames", "mask_power", "mask_spectrum"}));
    const Picture& power = pictures[1].picture;
    ASSERT_EQ(power.width % 32, 0);
    const auto waves = waves_of(power, power.width / 32);
    EXPECT_EQ(waves, (std::vector<std::array<int, 2>>{{-5, 3}, {5, -3}}));
}

TEST(BlueNoisePictures, TinyMasksHaveNoSpectrumAndBrokenOnesNoPictures) {
    const auto value = [](int x, int y, int) { return (x + 4 * y) / 16.0; };
    EXPECT_EQ(names_of(blue_noise_pictures(mask_of({4, 4, 1}, value))),
              std::vector<std::string>{"mask_frames"});
    EXPECT_EQ(blue_noise_pictures(mask_of({16, 16, 1}, value)).size(), 3U);
    PreviewAsset broken = mask_of({16, 16, 2}, value);
    broken.voxels.pop_back();
    EXPECT_TRUE(blue_noise_pictures(broken).empty());
}

TEST(WeatherMapPictures, ShowEachChannelTwiceAndItsHistogram) {
    PreviewAsset asset;
    asset.entry.name = "map";
    asset.entry.kind = "weather_map";
    asset.entry.size = {8, 4};
    asset.entry.channels = {"R", "G", "B"};
    asset.entry.levels.resize(1);
    asset.entry.levels[0].statistics.resize(3, {0, 1, 0.5, {0, 1}, {4, 4, 24}});
    asset.table = Image2<float>(8, 4, 3);
    for (std::size_t i = 0; i < asset.table.texels.size(); ++i) {
        asset.table.texels[i] = i % 3 == 1 ? 1.0F : 0.0F;
    }
    const std::vector<PreviewPicture> pictures = asset_pictures(asset);
    ASSERT_EQ(names_of(pictures),
              (std::vector<std::string>{"map_channels", "map_tiled", "map_histogram"}));
    // R is black, G beside it white.
    const Picture& channels = pictures[0].picture;
    const auto grey_at = [&](int x, int y) {
        return channels.rgb[3 * static_cast<std::size_t>(y * channels.width + x)];
    };
    EXPECT_EQ(grey_at(100, 60), 0);
    EXPECT_EQ(grey_at(400, 60), 255);
    asset.table = {};
    EXPECT_TRUE(weather_map_pictures(asset).empty());
}

}  // namespace

}  // namespace skybake
