#include "bakers/preview/pictures/cloud_pictures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <set>
#include <string>
#include <utility>

#include "bakers/preview/bake_assets.h"
#include "bakers/preview/cloud_inputs.h"
#include "bakers/render/stage_progress.h"
#include "config/assets/occupancy.h"
#include "tests/preview/captions.h"
#include "tests/preview/skies.h"

namespace skybake {
namespace {

// Air that costs little: the sky is not what these tests look at.
const PreviewAssets& cheap_air() {
    static const PreviewAssets air = test::baked(
        "preset = 'earth_hillaire'\n[bake.transmittance]\nsize = [64, 16]\n"
        "[bake.multiple_scattering]\nsize = [16, 16]\nmethod = 'converged'\nmapping = "
        "'hillaire'\n");
    return air;
}

// A cloud of 32 x 20 x 10 voxels, whose height is no multiple of the cell.
struct BakedCloud {
    config::Recipe recipe;
    PreviewAssets assets;

    // `warnings` are the codes of those that the bake gives.
    explicit BakedCloud(const std::string& cloud = "", const std::string& grid = "",
                        const std::vector<std::string>& warnings = {}) {
        recipe = test::recipe_of(
            "[noise.n]\nsize = [32, 32, 32]\n[noise.n.channels.Y]\ntype = \"worley\"\nfrequency = "
            "3\n"
            "octaves = 1\n[clouds.c]\nnoise = \"n\"\nextent = [\"3 km\", \"2 km\", \"0.7 km\"]\n"
            "base_altitude = \"1 km\"\ncoverage = 0.6\nextinction_scale = \"40 /km\"\n" +
                cloud +
                "\n[bake.sky]\nasset = \"cloud_volume\"\ncloud = \"c\"\nsize = [32, 20, 10]\n"
                "[bake.grid]\nasset = \"occupancy\"\nof = \"sky\"\n" +
                grid,
            {});
        auto baked =
            bake_assets(recipe, recipe.parameters.bakes, "test", {1, Certification::off, nullptr});
        std::vector<std::string> codes;
        for (const auto& diagnostic : baked.diagnostics) codes.push_back(diagnostic.code);
        EXPECT_EQ(codes, warnings) << cloud;
        if (baked.value) assets = std::move(*baked.value);
    }

    const PreviewAsset& asset(const std::string& name) const {
        for (const PreviewAsset& one : assets.assets) {
            if (one.entry.name == name) return one;
        }
        ADD_FAILURE() << name;
        return assets.assets.front();
    }
    const config::OccupancyBake& grid_bake() const {
        return recipe.parameters.bakes.back().as<config::OccupancyBake>();
    }
    CloudPreviewInput input() const {
        CloudPreviewInput input = input_under_earth();
        input.air = &*cheap_air().recipe;
        input.transmittance = cheap_air().of_kind("transmittance");
        input.multiple_scattering = cheap_air().of_kind("multiple_scattering");
        input.table_sky = true;
        return input;
    }
    CloudPreviewInput input_under_earth() const {
        CloudPreviewInput input;
        input.cloud = &recipe.parameters.clouds.front();
        input.volume = &asset("sky");
        input.occupancy = &asset("grid");
        input.occupancy_bake = &grid_bake();
        input.width = 64;
        input.height = 36;
        return input;
    }
};

std::set<std::string> names_of(const std::vector<PreviewPicture>& pictures) {
    std::set<std::string> names;
    for (const PreviewPicture& picture : pictures) {
        names.insert(picture.name);
        EXPECT_FALSE(picture.title.empty()) << picture.name;
        test::expect_sentences(picture);
        EXPECT_GT(picture.picture.width, 0) << picture.name;
        EXPECT_EQ(picture.picture.rgb.size(), 3U * static_cast<std::size_t>(picture.picture.width) *
                                                  static_cast<std::size_t>(picture.picture.height));
    }
    EXPECT_EQ(names.size(), pictures.size());
    return names;
}

// A recipe that states an atmosphere and bakes no table of it.
TEST(CloudPictures, HaveTheRecipesAir) {
    const BakedCloud baked;
    const config::Recipe mars =
        test::recipe_of("preset = \"mars_rgb\"\n[bake.transmittance]\n", {});
    CloudPreviewInput input = baked.input_under_earth();
    const auto on_earth = cloud_pictures(input, 2);
    input.air = &mars;
    const auto on_mars = cloud_pictures(input, 2);
    EXPECT_TRUE(test::says(on_mars[0], "the recipe's atmosphere"));
    EXPECT_EQ(on_earth[0].name, on_mars[0].name);
    // The sky at the upper left is blue on Earth, and red on Mars.
    EXPECT_GT(on_earth[0].picture.rgb[2], on_earth[0].picture.rgb[0]);
    EXPECT_LT(on_mars[0].picture.rgb[2], on_mars[0].picture.rgb[0]);
}

TEST(CloudPictures, ShowAVolumeWithItsGrid) {
    const BakedCloud baked;
    CloudPreviewInput input = baked.input_under_earth();
    input.suns = {{40, 100}, {-3, 100}};
    const auto pictures = cloud_pictures(input, 2);
    EXPECT_EQ(names_of(pictures),
              (std::set<std::string>{"sky_lit_sun_40", "sky_lit_sun_minus_3", "sky_optical_depth",
                                     "sky_slice_x", "sky_slice_y", "sky_slice_z", "grid_cells_y",
                                     "grid_cells_z"}));
    EXPECT_EQ(pictures[0].picture.width, 64);
    EXPECT_EQ(pictures[0].picture.height, 36);
    EXPECT_TRUE(test::says(pictures[0], "Leaping by grid"));
    EXPECT_TRUE(test::says(pictures[0], "the preset earth"));
    EXPECT_TRUE(test::says(pictures[0], "tone curve film"));
}

TEST(CloudPictures, OfADraftAreFewAndSmall) {
    const BakedCloud baked;
    CloudPreviewInput input = baked.input();
    input.draft = true;
    const auto pictures = cloud_pictures(input, 1);
    EXPECT_EQ(names_of(pictures), (std::set<std::string>{"sky_lit_sun_20", "sky_optical_depth",
                                                         "sky_slice_y", "grid_cells_y"}));
    EXPECT_EQ(pictures[0].picture.width, 32);
}

double mean_difference(const Picture& a, const Picture& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.rgb.size(); ++i) sum += std::abs(int{a.rgb[i]} - int{b.rgb[i]});
    return sum / static_cast<double>(a.rgb.size());
}

// The same picture from one tile further on would be the same if the tile repeated as it is.
TEST(CloudPictures, VaryTheCopiesOfATile) {
    const BakedCloud baked;
    CloudPreviewInput input = baked.input();
    input.draft = true;
    input.exposure_stops = 3;
    input.camera = {{{1500, 1000, 3000}}, 60, -20, 60};
    const PreviewPicture here = cloud_pictures(input, 1).front();
    EXPECT_TRUE(test::says(here, "so that no pattern repeats")) << here.caption;
    input.camera.position_m = {{4500, 1000, 3000}};
    const PreviewPicture next = cloud_pictures(input, 1).front();
    EXPECT_GT(mean_difference(here.picture, next.picture), 5);
    input.single = true;
    const PreviewPicture single = cloud_pictures(input, 1).front();
    EXPECT_FALSE(test::says(single, "repeats")) << single.caption;
}

// Returns the picture at half its size: each pixel is the mean of a square of four.
Picture quartered(const Picture& picture) {
    Picture small(picture.width / 2, picture.height / 2);
    const auto width = static_cast<std::size_t>(picture.width);
    for (std::size_t i = 0; i < small.rgb.size(); ++i) {
        const std::size_t pixel = i / 3;
        const std::size_t x = 2 * (pixel % static_cast<std::size_t>(small.width));
        const std::size_t y = 2 * (pixel / static_cast<std::size_t>(small.width));
        int sum = 0;
        for (const std::size_t at :
             {y * width + x, y * width + x + 1, (y + 1) * width + x, (y + 1) * width + x + 1}) {
            sum += picture.rgb[3 * at + i % 3];
        }
        small.rgb[i] = static_cast<std::uint8_t>(sum / 4);
    }
    return small;
}

// Few samples in thin cloud showed the pattern of their offsets. What a draft should look like: a
// picture eight times as wide, with shorter steps, reduced to the same size.
TEST(CloudPictures, OfADraftHaveNoGrainOfTheirSamples) {
    const BakedCloud baked;
    CloudPreviewInput input = baked.input();
    input.exposure_stops = 3;
    input.width = 768;
    input.height = 432;
    PreviewPicture fine = cloud_pictures(input, 2).front();
    EXPECT_TRUE(test::says(fine, "one ray per pixel")) << fine.caption;
    for (int i = 0; i < 3; ++i) fine.picture = quartered(fine.picture);
    input.draft = true;
    input.width = 192;
    input.height = 108;
    const PreviewPicture draft = cloud_pictures(input, 2).front();
    EXPECT_TRUE(test::says(draft, "4 rays per pixel")) << draft.caption;
    ASSERT_EQ(draft.picture.rgb.size(), fine.picture.rgb.size());
    EXPECT_LT(mean_difference(draft.picture, fine.picture), 2);
}

TEST(CloudPictures, HaveTheSizeTheCameraAndTheSunThatAreAskedFor) {
    const BakedCloud baked;
    CloudPreviewInput input = baked.input();
    input.width = 48;
    input.height = 64;
    input.camera.position_m = {{1000, 500, 3000}};
    input.camera.heading_degrees = 200;
    input.camera.pitch_degrees = -20;
    input.camera.field_degrees = 70;
    input.suns = {{30, 170}};
    const PreviewPicture picture = cloud_pictures(input, 1).front();
    EXPECT_EQ(picture.picture.width, 48);
    EXPECT_EQ(picture.picture.height, 64);
    EXPECT_TRUE(
        test::says(picture, "`position=1km,0.5km,3km heading=200deg pitch=-20deg fov=70deg`"))
        << picture.caption;
    EXPECT_TRUE(test::says(picture, "30 degrees to the right of the view")) << picture.caption;
    input.suns = {{30, 210}};
    const PreviewPicture other = cloud_pictures(input, 1).front();
    EXPECT_TRUE(test::says(other, "10 degrees to the left of the view")) << other.caption;
    EXPECT_NE(other.picture.rgb, picture.picture.rgb);
}

// Told of the march as it goes, and of nothing once it is over; an interruption ends it.
class Listener : public StageProgress {
  public:
    explicit Listener(int obeys_after) : calls_left_(obeys_after) {}
    void begin_stage(int, int, std::string_view) override {}
    void advance(std::string_view step, double fraction) override {
        if (!step.starts_with("lighting")) return;  // a step of the light of the sky
        --calls_left_;
        steps_.emplace(step);
        fractions_.push_back(fraction);
    }
    bool cancelled() const override { return calls_left_ <= 0; }

    int calls_left_;
    std::set<std::string> steps_;
    std::vector<double> fractions_;
};

TEST(CloudPictures, TellHowFarTheirLightIs) {
    const BakedCloud baked;
    CloudPreviewInput input = baked.input();
    input.suns = {{40, 100}, {20, 100}};
    Listener listener(1 << 20);
    input.progress = &listener;
    const auto pictures = cloud_pictures(input, 1);
    EXPECT_EQ(listener.steps_,
              (std::set<std::string>{"lighting, sun 40 deg", "lighting, sun 20 deg"}));
    ASSERT_GT(listener.fractions_.size(), 20U);
    EXPECT_TRUE(std::is_sorted(listener.fractions_.begin(), listener.fractions_.end()));
    EXPECT_EQ(listener.fractions_.back(), 1);
    Listener impatient(5);
    input.progress = &impatient;
    EXPECT_LT(cloud_pictures(input, 1).size(), pictures.size());
    EXPECT_EQ(impatient.fractions_.size(), 5U);
}

TEST(CloudPictures, DoNotDependOnTheGrid) {
    const BakedCloud baked;
    CloudPreviewInput input = baked.input();
    const auto with = cloud_pictures(input, 1);
    input.occupancy = nullptr;
    const auto without = cloud_pictures(input, 1);
    EXPECT_EQ(with[0].picture.rgb, without[0].picture.rgb);
    EXPECT_TRUE(test::says(without[0], "cells made from the volume"));
}

TEST(CloudPictures, ShowAGridAlone) {
    const BakedCloud baked("", "contents = [\"occupied\", \"minimum\", \"maximum\"]\n");
    CloudPreviewInput input = baked.input();
    input.volume = nullptr;
    EXPECT_EQ(names_of(cloud_pictures(input, 1)),
              (std::set<std::string>{"grid_occupied_y", "grid_occupied_z", "grid_minimum_y",
                                     "grid_minimum_z", "grid_maximum_y", "grid_maximum_z"}));
    input.cloud = nullptr;
    EXPECT_EQ(cloud_pictures(input, 1).size(), 6U);
    input.occupancy = nullptr;
    EXPECT_TRUE(cloud_pictures(input, 1).empty());
}

TEST(CloudPictures, ShowAnEmptyCloudAndARuntimesThreshold) {
    const BakedCloud empty("threshold = 3", "", {"W0215"});
    EXPECT_EQ(names_of(cloud_pictures(empty.input(), 1)).size(), 7U);
    const BakedCloud runtime("threshold_at = \"runtime\"\nthreshold = 0.2\nedge_softness = 0.1");
    EXPECT_EQ(names_of(cloud_pictures(runtime.input(), 1)).size(), 7U);
}

TEST(OccupancyLeaps, AreTheSameFromEveryChannel) {
    const BakedCloud leap("",
                          "contents = [\"leap\"]\npixel_type = \"unorm8\"\nformats = [\"bin\"]\n");
    const BakedCloud occupied("", "contents = [\"occupied\"]\n");
    const BakedCloud maximum("", "contents = [\"maximum\"]\npixel_type = \"float\"\n");
    const auto wanted = leaps_of_grid(leap.asset("grid"), leap.grid_bake(), 0);
    ASSERT_TRUE(wanted);
    EXPECT_EQ(wanted->size(), 16U * 10 * 5);
    EXPECT_EQ(leaps_of_grid(occupied.asset("grid"), occupied.grid_bake(), 0), wanted);
    EXPECT_EQ(leaps_of_grid(maximum.asset("grid"), maximum.grid_bake(), 0), wanted);
}

TEST(OccupancyLeaps, AreNoneWhereSomethingCouldBeLost) {
    const BakedCloud exact;
    const auto leaps = [](const BakedCloud& baked) {
        return leap_grid_of(baked.asset("sky"), baked.asset("grid"), baked.grid_bake(), 0);
    };
    ASSERT_TRUE(leaps(exact));
    EXPECT_EQ(leaps(exact)->cell, 2);
    EXPECT_TRUE(leaps(BakedCloud("", "filter = \"tricubic\"\n")));
    EXPECT_FALSE(leaps(BakedCloud("", "filter = \"nearest\"\n")));
    EXPECT_FALSE(leaps(BakedCloud("", "rule = \"thesis\"\n")));
    EXPECT_FALSE(leaps(BakedCloud("", "contents = [\"minimum\"]\n")));
}

}  // namespace
}  // namespace skybake
