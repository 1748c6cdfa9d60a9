#include "bakers/preview/cloud_pictures.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <variant>

#include "bakers/preview/bake_assets.h"
#include "bakers/preview/occupancy_leaps.h"
#include "tests/preview/clouds.h"
#include "tests/support/atmospheres.h"

namespace skybake {
namespace {

// A cloud of 32 x 20 x 10 voxels, whose height is no multiple of the cell.
struct Baked {
    config::Recipe recipe;
    PreviewAssets assets;

    explicit Baked(const std::string& cloud = "", const std::string& grid = "") {
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
        for (const auto& diagnostic : baked.diagnostics) ADD_FAILURE() << diagnostic.message;
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
        return std::get<config::OccupancyBake>(recipe.parameters.bakes.back().asset);
    }
    CloudPreviewInput input() const {
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
        EXPECT_FALSE(picture.caption.empty()) << picture.name;
        EXPECT_GT(picture.picture.width, 0) << picture.name;
        EXPECT_EQ(picture.picture.rgb.size(), 3U * static_cast<std::size_t>(picture.picture.width) *
                                                  static_cast<std::size_t>(picture.picture.height));
    }
    EXPECT_EQ(names.size(), pictures.size());
    return names;
}

bool says(const PreviewPicture& picture, const std::string& words) {
    return picture.caption.find(words) != std::string::npos;
}

TEST(CloudPictures, ShowAVolumeWithItsGrid) {
    const Baked baked;
    CloudPreviewInput input = baked.input();
    input.suns = {{40, 100}, {-3, 100}};
    const auto pictures = cloud_pictures(input, 2);
    EXPECT_EQ(
        names_of(pictures),
        (std::set<std::string>{"sky_lit_40", "sky_lit_-3", "sky_optical_depth", "sky_slice_x",
                               "sky_slice_y", "sky_slice_z", "grid_cells_y", "grid_cells_z"}));
    EXPECT_EQ(pictures[0].picture.width, 64);
    EXPECT_EQ(pictures[0].picture.height, 36);
    EXPECT_TRUE(says(pictures[0], "Leaping by grid"));
    EXPECT_TRUE(says(pictures[0], "the preset earth"));
    EXPECT_TRUE(says(pictures[0], "1 - exp"));
}

TEST(CloudPictures, OfADraftAreFewAndSmall) {
    const Baked baked;
    CloudPreviewInput input = baked.input();
    input.draft = true;
    const auto pictures = cloud_pictures(input, 1);
    EXPECT_EQ(names_of(pictures), (std::set<std::string>{"sky_lit_20", "sky_optical_depth",
                                                         "sky_slice_y", "grid_cells_y"}));
    EXPECT_EQ(pictures[0].picture.width, 32);
}

TEST(CloudPictures, DoNotDependOnTheGrid) {
    const Baked baked;
    CloudPreviewInput input = baked.input();
    const auto with = cloud_pictures(input, 1);
    input.occupancy = nullptr;
    const auto without = cloud_pictures(input, 1);
    EXPECT_EQ(with[0].picture.rgb, without[0].picture.rgb);
    EXPECT_TRUE(says(without[0], "cells made from the volume"));
}

TEST(CloudPictures, ShowAGridAlone) {
    const Baked baked("", "contents = [\"occupied\", \"minimum\", \"maximum\"]\n");
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
    for (const std::string cloud :
         {"threshold = 3", "threshold_at = \"runtime\"\nthreshold = 0.2\nedge_softness = 0.1"}) {
        const Baked baked(cloud);
        EXPECT_EQ(names_of(cloud_pictures(baked.input(), 1)).size(), 7U) << cloud;
    }
}

TEST(OccupancyLeaps, AreTheSameFromEveryChannel) {
    const Baked leap("", "contents = [\"leap\"]\npixel_type = \"unorm8\"\nformats = [\"bin\"]\n");
    const Baked occupied("", "contents = [\"occupied\"]\n");
    const Baked maximum("", "contents = [\"maximum\"]\npixel_type = \"float\"\n");
    const auto wanted = leaps_of_grid(leap.asset("grid"), leap.grid_bake(), 0);
    ASSERT_TRUE(wanted);
    EXPECT_EQ(wanted->size(), 8U * 5 * 3);
    EXPECT_EQ(leaps_of_grid(occupied.asset("grid"), occupied.grid_bake(), 0), wanted);
    EXPECT_EQ(leaps_of_grid(maximum.asset("grid"), maximum.grid_bake(), 0), wanted);
}

TEST(OccupancyLeaps, AreNoneWhereSomethingCouldBeLost) {
    const Baked exact;
    const auto leaps = [](const Baked& baked) {
        return leap_grid_of(baked.asset("sky"), baked.asset("grid"), baked.grid_bake(), 0);
    };
    ASSERT_TRUE(leaps(exact));
    EXPECT_EQ(leaps(exact)->cell, 4);
    EXPECT_TRUE(leaps(Baked("", "filter = \"tricubic\"\n")));
    EXPECT_FALSE(leaps(Baked("", "filter = \"nearest\"\n")));
    EXPECT_FALSE(leaps(Baked("", "rule = \"thesis\"\n")));
    EXPECT_FALSE(leaps(Baked("", "contents = [\"minimum\"]\n")));
}

}  // namespace
}  // namespace skybake
