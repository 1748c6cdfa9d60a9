#include "bakers/preview/pictures/asset_pictures.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>

#include "bakers/preview/pictures/fourier_transform.h"
#include "tests/support/volumes.h"

namespace skybake {
namespace {

constexpr double tau = 2 * std::numbers::pi;

// A volume whose voxels are a function of their indices.
PreviewAsset volume_of(std::array<int, 3> size, std::vector<std::string> channels,
                       const std::function<double(int x, int y, int z, int channel)>& value) {
    PreviewAsset asset;
    asset.entry.name = "noise";
    asset.entry.kind = "noise_volume";
    asset.entry.size = {size[0], size[1], size[2]};
    asset.entry.axes.resize(3);
    asset.entry.channels = std::move(channels);
    asset.entry.levels.resize(1);
    asset.entry.levels[0].size = size;
    asset.entry.levels[0].statistics.resize(asset.entry.channels.size(),
                                            {0, 1, 0.5, {0, 1}, std::vector<std::int64_t>(8, 100)});
    testing::for_each_voxel(size, [&](int x, int y, int z) {
        for (int c = 0; c < static_cast<int>(asset.entry.channels.size()); ++c) {
            asset.voxels.push_back(static_cast<float>(value(x, y, z, c)));
        }
    });
    return asset;
}

const PreviewPicture& named(const std::vector<PreviewPicture>& pictures, const std::string& name) {
    const auto found = std::find_if(pictures.begin(), pictures.end(),
                                    [&](const PreviewPicture& p) { return p.name == name; });
    if (found == pictures.end()) throw std::runtime_error("no picture " + name);
    return *found;
}

// --- Slices -------------------------------------------------------------------------------------

TEST(Slice, TakesThePlaneAcrossItsAxis) {
    const PreviewAsset asset = volume_of({3, 4, 5}, {"R", "G"}, [](int x, int y, int z, int c) {
        return x + 10 * y + 100 * z + 1000 * c;
    });
    const Image2<float> across_x = slice(view_of(asset), 1, 0, 2);
    EXPECT_EQ(across_x.width, 4);
    EXPECT_EQ(across_x.height, 5);
    EXPECT_EQ(*across_x.texel(1, 3), 1312);
    EXPECT_EQ(*slice(view_of(asset), 0, 1, 3).texel(2, 4), 432);
    EXPECT_EQ(*slice(view_of(asset), 0, 2, 1).texel(2, 3), 132);
}

// The largest change from one column to the next in the first tile of the sheet, and where it is.
struct Jump {
    int column = 0;
    int change = 0;
};
Jump largest_jump(const Picture& sheet) {
    constexpr int begin = 14, edge = 256;  // the sheet's gutter and a tile's width
    Jump jump;
    for (int x = begin; x + 1 < begin + edge; ++x) {
        const auto at = 3 * static_cast<std::size_t>((begin + 100) * sheet.width + x);
        const int change = std::abs(sheet.rgb[at] - sheet.rgb[at + 3]);
        if (change > jump.change) jump = {x - begin, change};
    }
    return jump;
}

TEST(NoisePictures, ShowASeamInTheTiledView) {
    const auto tiles = [](double planted) {
        const PreviewAsset asset = volume_of({64, 64, 64}, {"R"}, [&](int x, int, int, int) {
            return 0.4 + 0.2 * std::sin(tau * x / 64) + planted * x / 63;
        });
        return named(noise_pictures(asset), "noise_tiled").picture;
    };
    EXPECT_LT(largest_jump(tiles(0)).change, 8);
    const Jump seam = largest_jump(tiles(0.4));
    EXPECT_EQ(seam.column, 127) << "the last of the first copy's columns";
    EXPECT_NEAR(seam.change, 0.4 * 255, 8);
}

TEST(NoisePictures, HaveEachViewOnce) {
    const PreviewAsset asset = volume_of({8, 6, 4}, {"R", "G", "B", "A"},
                                         [](int x, int y, int z, int c) { return x ^ y ^ z ^ c; });
    const std::vector<PreviewPicture> pictures = noise_pictures(asset);
    ASSERT_EQ(pictures.size(), 3U);
    for (const char* name : {"slices", "tiled", "histogram"}) {
        EXPECT_GT(named(pictures, std::string("noise_") + name).picture.width, 200);
    }
}

TEST(NoisePictures, TakeSmallAndConstantVolumes) {
    for (const std::array<int, 3>& size : {std::array{1, 1, 1}, {1, 5, 2}, {2, 2, 2}, {7, 1, 3}}) {
        const PreviewAsset asset = volume_of(size, {"Y"}, [](int, int, int, int) { return -3.0; });
        const auto pictures = noise_pictures(asset);
        EXPECT_EQ(pictures.size(), 3U);
    }
}

// Seams and histograms say nothing of light; a shadow of one slice is a map.
TEST(NoisePictures, LightOfCloudsHasSlicesAlone) {
    const auto ramp = [](int x, int y, int z, int) { return x + y + 2 * z; };
    PreviewAsset light = volume_of({16, 16, 4}, {"Y"}, ramp);
    light.entry.kind = "cloud_light";
    const auto slices = noise_pictures(light);
    ASSERT_EQ(slices.size(), 1u);
    EXPECT_EQ(slices[0].name, "noise_slices");
    EXPECT_NE(slices[0].caption.find("Black is 0, white is 36."), std::string::npos);
    PreviewAsset shadow = volume_of({16, 16, 1}, {"Y"}, ramp);
    shadow.entry.kind = "cloud_light";
    const auto map = noise_pictures(shadow);
    ASSERT_EQ(map.size(), 1u);
    EXPECT_NE(map[0].caption.find("y up"), std::string::npos);
}

TEST(NoisePictures, OfDamagedAssetsAreNone) {
    const auto constant = [](int, int, int, int) { return 0.5; };
    PreviewAsset asset = volume_of({2, 2, 2}, {"Y"}, constant);
    asset.voxels.pop_back();
    EXPECT_TRUE(noise_pictures(asset).empty());
    asset = volume_of({2, 2, 2}, {"Y"}, constant);
    asset.entry.size = {2, 2};
    EXPECT_TRUE(noise_pictures(asset).empty());
    asset.entry.size = {2, -2, -2};
    EXPECT_TRUE(noise_pictures(asset).empty());
    EXPECT_TRUE(noise_pictures(PreviewAsset()).empty());
}

// --- Spectra ------------------------------------------------------------------------------------

TEST(FourierTransform, IsItsDefinition) {
    EXPECT_TRUE(rc::check([] {
        const int size = *rc::gen::inRange(1, 60);
        std::vector<std::complex<float>> line;
        for (int i = 0; i < size; ++i) {
            line.emplace_back(static_cast<float>(*rc::gen::inRange(-100, 100)),
                              static_cast<float>(*rc::gen::inRange(-100, 100)));
        }
        const std::vector<std::complex<float>> original = line;
        FourierTransform transform(size);
        transform(line);
        for (int k = 0; k < size; ++k) {
            std::complex<double> sum;
            for (int n = 0; n < size; ++n) {
                sum += std::complex<double>(original[static_cast<std::size_t>(n)]) *
                       std::polar(1.0, -tau * k * n / size);
            }
            RC_ASSERT(std::abs(sum - std::complex<double>(line[static_cast<std::size_t>(k)])) <
                      1e-5 * 150 * size);
        }
    }));
}

}  // namespace
}  // namespace skybake
