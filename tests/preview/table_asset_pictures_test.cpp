// Pictures of phase functions and of Bruneton's tables.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <string>

#include "bakers/preview/pictures/asset_pictures.h"

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
int largest_difference(const Picture& a, const Picture& b) {
    int largest = 0;
    for (std::size_t i = 0; i < std::min(a.rgb.size(), b.rgb.size()); ++i) {
        largest = std::max(largest, std::abs(a.rgb[i] - b.rgb[i]));
    }
    return largest;
}

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
        EXPECT_LE(largest_difference(turned[i].picture, seen[i].picture), 8) << seen[i].name;
        EXPECT_GT(largest_difference(moved[i].picture, seen[i].picture), 100) << seen[i].name;
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

}  // namespace
}  // namespace skybake
