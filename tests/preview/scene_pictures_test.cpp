#include "bakers/preview/pictures/scene_pictures.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "bakers/preview/cloud_inputs.h"
#include "bakers/preview/make_preview.h"
#include "tests/preview/captions.h"
#include "tests/preview/skies.h"

namespace skybake {
namespace {

// Two clouds, of which one was baked twice, and a sky.
PreviewAssets baked_scene() {
    return test::baked(
        "preset = \"earth_hillaire\"\n[noise.n]\nsize = [32, 32, 32]\n[noise.n.channels.Y]\n"
        "type = \"worley\"\nfrequency = 3\noctaves = 1\n"
        "[clouds.low]\nnoise = \"n\"\nextent = [\"3 km\", \"2 km\", \"0.7 km\"]\n"
        "base_altitude = \"1 km\"\ncoverage = 0.6\nextinction_scale = \"40 /km\"\n"
        "[clouds.high]\nnoise = \"n\"\nextent = [\"4 km\", \"4 km\", \"0.5 km\"]\n"
        "base_altitude = \"5 km\"\ncoverage = 0.6\nextinction_scale = \"5 /km\"\n"
        "[bake.transmittance]\nsize = [64, 16]\n[bake.multiple_scattering]\n"
        "method = \"converged\"\nmapping = \"hillaire\"\nsize = [16, 16]\n"
        "[bake.coarse]\nasset = \"cloud_volume\"\ncloud = \"low\"\nsize = [16, 10, 8]\n"
        "[bake.fine]\nasset = \"cloud_volume\"\ncloud = \"low\"\nsize = [32, 20, 10]\n"
        "[bake.veil]\nasset = \"cloud_volume\"\ncloud = \"high\"\nsize = [16, 16, 8]\n");
}

PreviewOptions small() {
    PreviewOptions options;
    options.picture_size = {{64, 36}};
    options.threads = 1;
    return options;
}

TEST(ScenePictures, ShowEachCloudOnceAtItsAltitude) {
    const PreviewAssets assets = baked_scene();
    PreviewOptions options = small();
    options.sun_elevations_deg = {40, -3};
    const std::vector<CloudPreviewInput> layers = scene_input(assets, options);
    ASSERT_EQ(layers.size(), 2U);
    EXPECT_EQ(layers[0].volume->entry.name, "fine");
    EXPECT_EQ(layers[1].volume->entry.name, "veil");
    const auto pictures = scene_pictures(layers, 1);
    ASSERT_EQ(pictures.size(), 3U);
    EXPECT_EQ(pictures[0].name, "scene_sun_40");
    EXPECT_EQ(pictures[1].name, "scene_sun_minus_3");
    EXPECT_EQ(pictures[2].name, "scene_sun_40_against");
    for (const PreviewPicture& picture : pictures) {
        test::expect_sentences(picture);
        EXPECT_EQ(picture.picture.width, 64);
        EXPECT_EQ(picture.picture.height, 36);
        EXPECT_EQ(picture.kind, PictureKind::scene);
        EXPECT_TRUE(test::says(picture, "fine from 1 to 1.7 km and veil from 5 to 5.5 km"));
        EXPECT_TRUE(test::says(picture, "the recipe's atmosphere"));
        EXPECT_TRUE(test::says(picture, "no pattern repeats"));
    }
    // Neither layer alone gives the picture of both.
    for (const CloudPreviewInput& layer : layers) {
        EXPECT_NE(scene_pictures({layer}, 1).at(0).picture.rgb, pictures[0].picture.rgb);
    }
    EXPECT_EQ(scene_pictures({layers[1], layers[0]}, 2).at(0).picture.rgb, pictures[0].picture.rgb);
}

TEST(ScenePictures, AreNoneWithoutVolumes) {
    EXPECT_TRUE(scene_pictures({}, 1).empty());
    EXPECT_TRUE(scene_pictures({CloudPreviewInput()}, 1).empty());
}

TEST(ScenePictures, ObeyTheCamera) {
    const PreviewAssets assets = baked_scene();
    PreviewOptions options = small();
    options.camera = CameraRequest{{{1500, 1000, 3000}}, 20, -10, 40};
    const auto pictures = scene_pictures(scene_input(assets, options), 1);
    ASSERT_EQ(pictures.size(), 2U);
    for (const PreviewPicture& picture : pictures) {
        EXPECT_TRUE(
            test::says(picture, "position=1.5km,1km,3km heading=20deg pitch=-10deg fov=40deg"))
            << picture.caption;
    }
}

// The page has the scene unless a single tile is asked for.
TEST(ScenePictures, AreOnThePage) {
    const PreviewAssets assets = baked_scene();
    const auto scenes_with = [&](const PreviewOptions& options) {
        const auto page = make_preview(assets, options);
        EXPECT_TRUE(page.value);
        std::vector<std::string> titles;
        for (const PageScene& scene : page.value->scenes) titles.push_back(scene.title);
        return titles;
    };
    PreviewOptions options = small();
    options.draft = true;
    EXPECT_EQ(scenes_with(options), (std::vector<std::string>{"One sky", "Sky"}));
    options.single = true;
    EXPECT_EQ(scenes_with(options), (std::vector<std::string>{"Sky"}));
    const LitPictures sky_only = {true, false, false};
    EXPECT_FALSE(has_scene(sky_only, PreviewOptions()));
    const LitPictures clouds_only = {false, true, false};
    EXPECT_FALSE(has_scene(clouds_only, PreviewOptions()));
}

}  // namespace
}  // namespace skybake
