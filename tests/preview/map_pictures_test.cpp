// Pictures of weather maps and of blue noise.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "bakers/preview/pictures/asset_pictures.h"

namespace skybake {
namespace {

constexpr double tau = 2 * std::numbers::pi;

PreviewAsset mask_of(const std::array<int, 3>& size,
                     const std::function<double(int x, int y, int t)>& value) {
    PreviewAsset asset;
    asset.entry.name = "mask";
    asset.entry.kind = "blue_noise";
    asset.entry.size = {size[0], size[1], size[2]};
    asset.entry.axes.resize(3);
    asset.entry.channels = {"Y"};
    for (int t = 0; t < size[2]; ++t) {
        for (int y = 0; y < size[1]; ++y) {
            for (int x = 0; x < size[0]; ++x) {
                asset.voxels.push_back(static_cast<float>(value(x, y, t)));
            }
        }
    }
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
