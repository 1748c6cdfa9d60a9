// The clouds that travel with the program are as thick, as dense and as tall as those of nature;
// config/presets/clouds/*.toml say where the ranges come from.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/clouds/cloud_field.h"
#include "bakers/clouds/cloud_plan.h"
#include "bakers/clouds/grown_volume.h"
#include "config/assets/cloud_volume.h"
#include "config/presets/presets.h"
#include "config/recipe/init_text.h"
#include "config/recipe/recipe.h"

namespace skybake::cloud {
namespace {

// A lidar sees no less than this.
constexpr double cloudy = 0.3;

// Ranges of vertical optical depths. ISCCP (Rossow and Schiffer 1999, "Advances in understanding clouds
// from ISCCP") calls less than 3.6 cumulus, altocumulus or cirrus by its altitude, up to 23
// stratocumulus, and more than that stratus or deep convection; it knows nothing above 379. Its pixels
// of 5 km mix cumuli with clear sky, so that single cumuli have more.
struct NaturalRange {
    const char* preset;
    std::array<double, 2> largest;
    std::array<double, 2> median;  // over columns that are cloudy
    std::array<double, 2> cover;   // share of columns that are
    float core = 0.95F;            // the greatest density is at least this
};

constexpr std::array ranges = {
    NaturalRange{"altocumulus", {2, 8}, {0.5, 3.6}, {0.4, 0.9}},
    // Layers of ice clouds have at least 0.5 (Heymsfield, Matrosov and Baum 2003, J. Appl. Meteor. 42).
    NaturalRange{"cirrus", {0.5, 3.6}, {cloudy, 3.6}, {0.2, 0.8}},
    // Air that rises 9 km mixes on its way; cores that keep half of the water of unmixed air have the density
    // 0.63, its power of 2/3.
    NaturalRange{"cumulonimbus", {379, 2000}, {23, 379}, {0.1, 0.6}, 0.63F},
    NaturalRange{"cumulus_congestus", {60, 379}, {15, 150}, {0.1, 0.5}},
    NaturalRange{"cumulus_humilis", {15, 60}, {3.6, 23}, {0.1, 0.5}},
    NaturalRange{"cumulus_mediocris", {30, 150}, {3.6, 60}, {0.1, 0.5}},
    NaturalRange{"fog_bank", {2, 10}, {1, 6}, {0.9, 1}},
    NaturalRange{"stratocumulus", {10, 30}, {3.6, 23}, {0.6, 0.97}},
    NaturalRange{"stratus", {10, 40}, {10, 25}, {0.99, 1}},
};

struct BakedPreset {
    config::Cloud cloud;
    std::array<int, 3> size{};
    std::vector<double> optical_depths;  // of columns of every 16th row
    std::vector<float> greatest;         // density of each level
};

const config::Noise& noise_named(const config::Parameters& parameters, const std::string& name) {
    return *std::find_if(parameters.noises.begin(), parameters.noises.end(),
                         [&](const config::Noise& noise) { return noise.name == name; });
}

CloudField field_of(const config::Parameters& parameters, const std::array<int, 3>& size) {
    const config::Cloud& cloud = parameters.clouds.at(0);
    const config::Noise* detail =
        cloud.detail.empty() ? nullptr : &noise_named(parameters, cloud.detail);
    if (cloud.shape == config::CloudShape::convection) {
        const auto grown = convection::grow(convection::specification_of(cloud), {});
        return CloudField(
            make_cloud_plan(cloud, volume_of_grown(grown, cloud, size), detail, size, {}));
    }
    return CloudField(
        make_cloud_plan(cloud, noise_named(parameters, cloud.noise), detail, size, {}));
}

BakedPreset baked(const std::string& preset) {
    const auto recipe =
        config::parse_recipe(config::cloud_init_text(*config::find_cloud_preset(preset)), preset);
    EXPECT_TRUE(recipe.value && recipe.diagnostics.empty()) << preset;
    const config::Parameters& parameters = recipe.value->parameters;
    BakedPreset result;
    result.cloud = parameters.clouds.at(0);
    result.size = parameters.bakes.at(0).as<config::CloudVolumeBake>().size;
    const CloudField field = field_of(parameters, result.size);
    const auto [width, rows, depth] = result.size;
    const double step_m = result.cloud.extent[2].meters / depth;
    result.greatest.resize(static_cast<std::size_t>(depth));
    constexpr int stride = 16;
    std::vector<float> densities(static_cast<std::size_t>(width * depth));
    for (int y = stride / 2; y < rows; y += stride) {
        field.fill({{0, y, 0}, {width, 1, depth}}, {densities.data()});
        std::vector<double> sums(static_cast<std::size_t>(width));
        for (std::size_t i = 0; i < densities.size(); ++i) {
            const std::size_t z = i / static_cast<std::size_t>(width);
            sums[i % static_cast<std::size_t>(width)] += double{densities[i]};
            result.greatest[z] = std::max(result.greatest[z], densities[i]);
        }
        for (const double sum : sums) {
            result.optical_depths.push_back(sum * step_m * result.cloud.extinction_scale.per_meter);
        }
    }
    std::sort(result.optical_depths.begin(), result.optical_depths.end());
    return result;
}

void expect_natural(const NaturalRange& range) {
    SCOPED_TRACE(range.preset);
    const BakedPreset preset = baked(range.preset);
    const std::vector<double>& depths = preset.optical_depths;
    const auto first = std::upper_bound(depths.begin(), depths.end(), cloudy);
    ASSERT_NE(first, depths.end());
    const double cover =
        static_cast<double>(depths.end() - first) / static_cast<double>(depths.size());
    const double median = *(first + (depths.end() - first) / 2);
    const float greatest = *std::max_element(preset.greatest.begin(), preset.greatest.end());
    const auto used = std::count_if(preset.greatest.begin(), preset.greatest.end(),
                                    [](float density) { return density > 0; });
    fmt::print(
        "{}: greatest density {}, largest depth {:.1f}, median {:.1f}, cover {:.2f}, "
        "levels {} of {}\n",
        range.preset, greatest, depths.back(), median, cover, used, preset.size[2]);
    EXPECT_GE(greatest, range.core);
    EXPECT_LE(greatest, 1.0F);
    EXPECT_GE(depths.back(), range.largest[0]);
    EXPECT_LE(depths.back(), range.largest[1]);
    EXPECT_GE(median, range.median[0]);
    EXPECT_LE(median, range.median[1]);
    EXPECT_GE(cover, range.cover[0]);
    EXPECT_LE(cover, range.cover[1]);
    EXPECT_GE(static_cast<double>(used), 0.9 * preset.size[2]);
}

bool grows(std::string_view preset) { return preset.starts_with("cumul"); }

TEST(CloudPresets, AreAsThickAsNature) {
    for (const NaturalRange& range : ranges) {
        if (!grows(range.preset)) expect_natural(range);
    }
}

// They take minutes.
TEST(CloudPresets, WhatGrowsIsAsThickAsNature) {
    for (const NaturalRange& range : ranges) {
        if (grows(range.preset)) expect_natural(range);
    }
}

TEST(CloudPresets, AllHaveARange) {
    for (const config::Preset& preset : config::cloud_presets()) {
        const bool has_range =
            std::any_of(ranges.begin(), ranges.end(),
                        [&](const NaturalRange& range) { return range.preset == preset.name; });
        EXPECT_EQ(has_range, preset.name != "thesis") << preset.name;
    }
}

// OpenVDB's own ray tracer takes no others.
TEST(CloudPresets, HaveVoxelsThatAreCubes) {
    for (const config::Preset& preset : config::cloud_presets()) {
        const auto recipe = config::parse_recipe(config::cloud_init_text(preset), "init");
        ASSERT_TRUE(recipe.value) << preset.name;
        EXPECT_TRUE(recipe.diagnostics.empty()) << preset.name << " warns out of the box";
        const auto& extent = recipe.value->parameters.clouds.at(0).extent;
        const auto& size = recipe.value->parameters.bakes.at(0).as<config::CloudVolumeBake>().size;
        for (std::size_t axis = 1; axis < 3; ++axis) {
            EXPECT_DOUBLE_EQ(extent[axis].meters / size[axis], extent[0].meters / size[0])
                << preset.name;
        }
    }
}

}  // namespace
}  // namespace skybake::cloud
