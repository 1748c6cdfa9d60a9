// The clouds that travel with the program are as thick, as dense and as tall as those of nature;
// config/presets/clouds/*.toml say where the ranges come from.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
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
};

constexpr std::array ranges = {
    NaturalRange{"altocumulus", {2, 8}, {0.5, 3.6}, {0.4, 0.9}},
    // Layers of ice clouds have at least 0.5 (Heymsfield, Matrosov and Baum 2003, J. Appl. Meteor. 42).
    NaturalRange{"cirrus", {0.5, 3.6}, {cloudy, 3.6}, {0.2, 0.8}},
    NaturalRange{"cumulonimbus", {379, 2000}, {23, 379}, {0.1, 0.6}},
    // The largest is above what ISCCP knows.
    NaturalRange{"cumulus_congestus", {60, 1000}, {15, 150}, {0.1, 0.5}},
    NaturalRange{"cumulus_humilis", {15, 60}, {3.6, 23}, {0.1, 0.5}},
    NaturalRange{"cumulus_mediocris", {30, 150}, {3.6, 60}, {0.1, 0.5}},
    NaturalRange{"fog_bank", {2, 10}, {1, 6}, {0.9, 1}},
    NaturalRange{"stratocumulus", {10, 30}, {3.6, 23}, {0.6, 0.97}},
    NaturalRange{"stratus", {10, 40}, {10, 25}, {0.99, 1}},
};

struct BakedPreset {
    std::array<int, 3> size{};
    std::vector<double>
        columns;  // optical depths, x first; of clouds that do not grow every 16th row
    std::vector<double> optical_depths;  // the same, sorted
    std::vector<float> greatest;         // density of each level
    double cut = 0;                      // columns with cloud at the top of the box
};

// Which columns of a tile hold cloud.
struct Outline {
    int width = 0;
    int rows = 0;
    std::vector<char> cloudy;

    std::array<std::size_t, 4> neighbours(std::size_t at) const {
        const auto x = at % static_cast<std::size_t>(width),
                   y = at / static_cast<std::size_t>(width);
        const auto columns = static_cast<std::size_t>(width),
                   lines = static_cast<std::size_t>(rows);
        return {y * columns + (x + 1) % columns, y * columns + (x + columns - 1) % columns,
                (y + 1) % lines * columns + x, (y + lines - 1) % lines * columns + x};
    }
};

// The area and the perimeter of the cloud that holds a column, in columns and their edges. It is cleared.
std::array<double, 2> taken_cloud(Outline& outline, const Outline& whole, std::size_t first) {
    std::array<double, 2> size{};
    std::vector<std::size_t> open = {first};
    outline.cloudy[first] = 0;
    while (!open.empty()) {
        const std::size_t at = open.back();
        open.pop_back();
        ++size[0];
        for (const std::size_t near : whole.neighbours(at)) {
            if (!whole.cloudy[near]) ++size[1];
            if (outline.cloudy[near]) open.push_back(near);
            outline.cloudy[near] = 0;
        }
    }
    return size;
}

// The dimension D of outlines by their law: the perimeter of clouds is as the power D / 2 of their area
// (Lovejoy 1982, "Area-perimeter relation for rain and cloud areas", Science 216).
double outline_dimension(const Outline& outline) {
    constexpr double kSmallest = 40;  // columns
    Outline left = outline;
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (std::size_t at = 0; at < outline.cloudy.size(); ++at) {
        if (!left.cloudy[at]) continue;
        const auto [area, perimeter] = taken_cloud(left, outline, at);
        if (area < kSmallest || perimeter == 0) continue;
        const double a = std::log(area), p = std::log(perimeter);
        n += 1, x += a, y += p, xx += a * a, xy += a * p;
    }
    return 2 * (n * xy - x * y) / (n * xx - x * x);
}

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
            make_cloud_plan(cloud, volume_of_grown(grown, cloud, detail, size), detail, size, {}));
    }
    return CloudField(
        make_cloud_plan(cloud, noise_named(parameters, cloud.noise), detail, size, {}));
}

BakedPreset baked(const std::string& preset) {
    const auto recipe = config::parse_recipe(
        config::cloud_init_text(*config::find_preset(config::cloud_presets(), preset)), preset);
    EXPECT_TRUE(recipe.value && recipe.diagnostics.empty()) << preset;
    const config::Parameters& parameters = recipe.value->parameters;
    BakedPreset result;
    const config::Cloud& cloud = parameters.clouds.at(0);
    result.size = parameters.bakes.at(0).as<config::CloudVolumeBake>().size;
    const CloudField field = field_of(parameters, result.size);
    const auto [width, rows, depth] = result.size;
    const double step_m = cloud.extent[2].meters / depth;
    result.greatest.resize(static_cast<std::size_t>(depth));
    const int stride = cloud.shape == config::CloudShape::convection ? 1 : 16;
    std::vector<float> densities(static_cast<std::size_t>(width * depth));
    for (int y = stride / 2; y < rows; y += stride) {
        field.fill({{0, y, 0}, {width, 1, depth}}, {densities.data()});
        std::vector<double> sums(static_cast<std::size_t>(width));
        for (std::size_t i = 0; i < densities.size(); ++i) {
            const std::size_t z = i / static_cast<std::size_t>(width);
            sums[i % static_cast<std::size_t>(width)] += double{densities[i]};
            result.greatest[z] = std::max(result.greatest[z], densities[i]);
            if (z + 1 == result.greatest.size() && densities[i] > 0) ++result.cut;
        }
        for (const double sum : sums) {
            result.columns.push_back(sum * step_m * cloud.extinction_scale.per_meter);
        }
    }
    result.optical_depths = result.columns;
    std::sort(result.optical_depths.begin(), result.optical_depths.end());
    return result;
}

void expect_natural(const NaturalRange& range, const BakedPreset& preset) {
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
    // No cell of a storm holds what unmixed air would, nor does cloud below the top of its layer.
    const std::string_view name = range.preset;
    const bool is_less = name == "cumulonimbus" || name.starts_with("strat");
    EXPECT_GE(greatest, is_less ? 0.7F : 0.95F);
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
        SCOPED_TRACE(range.preset);
        if (!grows(range.preset)) expect_natural(range, baked(range.preset));
    }
}

// Nature has 1.35, and fields that are smooth at their edges have 1. The few clouds of a tile say little more
// than which of the two they are nearer to.
constexpr double kRoughest = 1.45, kSmoothest = 1.2;

// The cumulonimbus stands alone.
void expect_grown_as_nature(const NaturalRange& range) {
    SCOPED_TRACE(range.preset);
    const BakedPreset preset = baked(range.preset);
    expect_natural(range, preset);
    // A bake warns of more (W0230).
    const auto whole =
        std::ranges::count_if(preset.columns, [](double depth) { return depth > cloudy; });
    EXPECT_LE(preset.cut, 0.01 * static_cast<double>(whole));
    if (std::string_view(range.preset) == "cumulonimbus") return;
    Outline outline{preset.size[0], preset.size[1], {}};
    for (const double depth : preset.columns) outline.cloudy.push_back(depth > 1);
    const double dimension = outline_dimension(outline);
    fmt::print("{}: the outline's dimension is {:.2f}\n", range.preset, dimension);
    EXPECT_GE(dimension, kSmoothest);
    EXPECT_LE(dimension, kRoughest);
}

bool is_smallest(std::string_view preset) { return preset == "cumulus_humilis"; }

TEST(CloudPresets, TheSmallestCumuliAreAsThickAndAsRoughAsNature) {
    expect_grown_as_nature(*std::ranges::find_if(ranges, is_smallest, &NaturalRange::preset));
}

// They take minutes.
TEST(SlowCloudPresets, WhatElseGrowsIsAsThickAndAsRoughAsNature) {
    for (const NaturalRange& range : ranges) {
        if (grows(range.preset) && !is_smallest(range.preset)) expect_grown_as_nature(range);
    }
}

TEST(CloudPresets, DimensionsAreThoseOfKnownOutlines) {
    Outline discs{320, 320, std::vector<char>(320 * 320)};
    for (int at = 0; at < 320 * 320; ++at) {
        const int disc = at % 320 / 40 + at / 320 / 40 * 8;  // 64 of them, with radii from 5 to 18
        const double x = at % 320 % 40 - 19.5, y = at / 320 % 40 - 19.5;
        discs.cloudy[static_cast<std::size_t>(at)] = std::hypot(x, y) < 5 + 0.2 * disc;
    }
    EXPECT_NEAR(outline_dimension(discs), 1, 0.05);
    // Rectangles of n by n^2 columns have areas of n^3 and perimeters of about n^2.
    Outline rectangles{1000, 120, std::vector<char>(120'000)};
    int row = 1;
    for (const int n : {14, 18, 23, 30}) {
        for (int y = row; y < row + n; ++y) {
            std::fill_n(rectangles.cloudy.begin() + 1000 * y, n * n, char{1});
        }
        row += n + 2;
    }
    EXPECT_NEAR(outline_dimension(rectangles), 4.0 / 3, 0.05);
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
