#include "bakers/preview/pictures/asset_pictures.h"

#include <gtest/gtest.h>

#include "tests/preview/skies.h"

namespace skybake {
namespace {

PreviewAsset bake_one(const std::string& section) {
    return test::baked("preset = 'earth_hillaire'\n[bake.a]\n" + section).assets.at(0);
}

bool is_black(const Picture& picture) {
    return std::all_of(picture.rgb.begin(), picture.rgb.end(),
                       [](std::uint8_t value) { return value == 0; });
}

TEST(SkyAssetPictures, ShowEachSunOfASkyViewWithItsOwnExposure) {
    const PreviewAsset view = bake_one(
        "asset = 'sky_view'\nsize = [8, 6]\norders = 'single'\n"
        "sun_elevations = ['30 deg', '-4 deg']\n");
    const auto pictures = asset_pictures(view);
    ASSERT_EQ(pictures.size(), 2u);
    EXPECT_EQ(pictures[0].name, "a_sun_30");
    EXPECT_NE(pictures[1].title.find("4 degrees below the horizon"), std::string::npos);
    EXPECT_GT(pictures[1].exposure.value_or(0), pictures[0].exposure.value_or(0));
    for (const PreviewPicture& picture : pictures) EXPECT_FALSE(is_black(picture.picture));
}

// The sky is bright about the sun in the middle, and the zenith stands above the ground.
TEST(SkyAssetPictures, ShowAnEnvironmentUpright) {
    const auto pictures =
        asset_pictures(bake_one("asset = 'environment'\nsize = [16, 8]\norders = 'single'\n"
                                "sun_elevation = '20 deg'\n"));
    ASSERT_EQ(pictures.size(), 1u);
    const Picture& picture = pictures[0].picture;
    const auto brightness = [&picture](double x, double y) {
        const auto at = 3 * (static_cast<std::size_t>(y * picture.height) *
                                 static_cast<std::size_t>(picture.width) +
                             static_cast<std::size_t>(x * picture.width));
        return picture.rgb[at] + picture.rgb[at + 1] + picture.rgb[at + 2];
    };
    EXPECT_GT(brightness(0.55, 0.4), brightness(0.55, 0.8)) << "sky above, dark ground below";
    EXPECT_GT(brightness(0.55, 0.4), brightness(0.15, 0.4)) << "the sun in the middle";
}

std::string caption_of_environment(const std::string& keys) {
    const auto pictures = asset_pictures(
        bake_one("asset = 'environment'\norders = 'single'\nsun_elevation = '20 deg'\n" + keys));
    return pictures.size() == 1 ? pictures[0].caption : "";
}

TEST(SkyAssetPictures, SayWhereDirectionsAreInAnEnvironment) {
    const auto says = [](const std::string& keys, const std::string& words) {
        return caption_of_environment(keys).find(words) != std::string::npos;
    };
    EXPECT_TRUE(says("size = [16, 8]", "straight ahead in the middle"));
    EXPECT_TRUE(says("size = [16, 8]", "The sun is straight ahead; its disc is not in the file."));
    EXPECT_TRUE(says("size = [16, 8]\nsun_azimuth = '-50 deg'", "50 degrees to the left"));
    EXPECT_TRUE(says("size = [16, 8]\nsun_azimuth = '40 deg'", "40 degrees to the right"));
    EXPECT_TRUE(says("size = [64, 32]\nsun = 'disc'", "its disc is in the file"));
    EXPECT_TRUE(says("size = [4, 24]\nmapping = 'cube'", "the faces right, left, up, down"));
    EXPECT_FALSE(says("size = [4, 24]\nmapping = 'cube'", "in the middle"));
    EXPECT_TRUE(says("size = [8, 8]\nmapping = 'octahedral'", "the zenith in the middle"));
}

// The parameters of a map with clouds hold the bakes of the clouds too.
TEST(SkyAssetPictures, FindTheEnvironmentAmongTheBakesThatItIsMadeOf) {
    PreviewAsset asset = bake_one(
        "asset = 'environment'\nsize = [16, 8]\norders = 'single'\n"
        "sun_elevation = '20 deg'\nsun_azimuth = '40 deg'\n");
    asset.entry.parameters += "[bake.before]\nasset = 'transmittance'\nsize = [24, 8]\n";
    const auto pictures = asset_pictures(asset);
    ASSERT_EQ(pictures.size(), 1u);
    EXPECT_NE(pictures[0].caption.find("40 degrees to the right"), std::string::npos);
}

TEST(SkyAssetPictures, ShowIrradiances) {
    const auto pictures =
        asset_pictures(bake_one("asset = 'irradiance'\nsize = [8, 6]\ncontent = 'direct'\n"));
    ASSERT_EQ(pictures.size(), 1u);
    EXPECT_FALSE(is_black(pictures[0].picture));
}

TEST(SkyAssetPictures, ShowLightAndTransmittanceOfTheAir) {
    const std::string volume =
        "asset = 'aerial_perspective'\nsize = [4, 3, 8]\norders = 'single'\n"
        "sun_elevation = '20 deg'\naltitude = '1 km'\n";
    const auto both = aerial_pictures(bake_one(volume));
    ASSERT_EQ(both.size(), 2u);
    EXPECT_EQ(both[0].name, "a_light");
    EXPECT_EQ(both[1].name, "a_transmittance");
    EXPECT_EQ(aerial_pictures(bake_one(volume + "content = 'in_scatter'\n")).size(), 1u);
    EXPECT_EQ(aerial_pictures(bake_one(volume + "content = 'transmittance'\n")).size(), 1u);
    // One slice is shown once.
    EXPECT_EQ(aerial_pictures(bake_one("asset = 'aerial_perspective'\nsize = [4, 3, 1]\n"
                                       "orders = 'single'\nsun_elevation = '20 deg'\n"))
                  .size(),
              2u);
}

TEST(SkyAssetPictures, ShowNothingOfWhatIsIncomplete) {
    PreviewAsset view = bake_one(
        "asset = 'sky_view'\nsize = [8, 6]\norders = 'single'\nsun_elevations = '30 deg'\n");
    view.table = Image2<float>(8, 5, 3);
    EXPECT_TRUE(sky_view_pictures(view).empty());
    EXPECT_TRUE(aerial_pictures(view).empty());
    view.entry.parameters = "no recipe";
    EXPECT_TRUE(sky_view_pictures(view).empty());
}

}  // namespace
}  // namespace skybake
