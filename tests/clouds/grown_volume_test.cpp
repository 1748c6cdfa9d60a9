// The voxels of a cloud that has grown, between the cells in which it grew.
#include "bakers/clouds/grown_volume.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "bakers/clouds/cloud_plan.h"
#include "bakers/noise/noise_reference.h"
#include "config/recipe/recipe.h"
#include "tests/support/volumes.h"

namespace skybake::cloud {
namespace {

using convection::GrownCloud;

std::shared_ptr<GrownCloud> random_cloud(const std::array<int, 3>& cells, float mean = -0.5F) {
    std::mt19937 random(4);
    std::normal_distribution<float> number(mean, 1);
    auto cloud = std::make_shared<GrownCloud>();
    cloud->cells = cells;
    cloud->full_water = 2;
    cloud->water.resize(static_cast<std::size_t>(cells[0] * cells[1] * cells[2]));
    for (float& water : cloud->water) water = number(random);
    return cloud;
}

std::vector<float> filled(const VoxelSource& source, const VoxelBox& box) {
    std::vector<float> values(static_cast<std::size_t>(box.count()), -1);
    source.fill(box, {values.data()});
    return values;
}

double density(double water, double full) {
    return water <= 0 ? 0 : std::min(1.0, std::pow(water / full, 2.0 / 3));
}

// Where water is even, edges have no slope and cells are what they hold. A coverage adds water to all.
TEST(GrownVolume, IsTheDensityOfItsCells) {
    for (const float water : {-0.5F, 0.0F, 0.3F, 1.0F, 3.0F}) {
        for (const double coverage : {0.25, 0.75, 1.0, 2.0}) {
            const auto cloud = random_cloud({6, 4, 5});
            std::ranges::fill(cloud->water, water);
            const GrownVolume volume(cloud, {10, 10, 10}, {6, 4, 5}, {}, coverage);
            for (const float value : filled(volume, {{}, {6, 4, 5}})) {
                EXPECT_NEAR(double{value}, density(double{water} + 2 * (coverage - 1), 2), 1e-6);
            }
        }
    }
}

// Catmull and Rom's cubic in one dimension, in double precision.
double cubic(const std::array<double, 4>& p, double t) {
    const double value = p[1] + 0.5 * t *
                                    ((p[2] - p[0]) + t * ((2 * p[0] - 5 * p[1] + 4 * p[2] - p[3]) +
                                                          t * (3 * (p[1] - p[2]) + p[3] - p[0])));
    return std::clamp(value, std::min(p[1], p[2]), std::max(p[1], p[2]));
}

double water_of(const GrownCloud& cloud, const std::array<int, 3>& cell) {
    const auto& [nx, ny, nz] = cloud.cells;
    const int x = (cell[0] + 2 * nx) % nx, y = (cell[1] + 2 * ny) % ny;
    const int z = std::clamp(cell[2], 0, nz - 1);
    return double{cloud.water[static_cast<std::size_t>((z * ny + y) * nx + x)]};
}

// A field at a place in cells, along the axes from x on.
template <class Field>
double between_cells(const Field& field, std::array<int, 3> cell, const std::array<double, 3>& at,
                     int axes) {
    if (axes == 0) return field(cell);
    const auto axis = static_cast<std::size_t>(axes - 1);
    const int below = static_cast<int>(std::floor(at[axis]));
    std::array<double, 4> values{};
    for (int i = 0; i < 4; ++i) {
        cell[axis] = below - 1 + i;
        values[static_cast<std::size_t>(i)] = between_cells(field, cell, at, axes - 1);
    }
    return cubic(values, at[axis] - below);
}

// The water that relief adds where noise is 1 and r is 1 m: the steepness of cells, by differences of two
// cells, smoothed by (1, 2, 1) / 4 along each axis.
double slope_of(const GrownCloud& cloud, std::array<int, 3> cell,
                const std::array<double, 3>& cell_m) {
    cell[2] = std::clamp(cell[2], 0, cloud.cells[2] - 1);  // it goes on as the outermost cells are
    double sum = 0;
    for (int i = 0; i < 27; ++i) {
        const std::array<int, 3> step = {i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1};
        std::array<int, 3> near = cell;
        for (std::size_t axis = 0; axis < 3; ++axis) near[axis] += step[axis];
        near[2] = std::clamp(near[2], 0, cloud.cells[2] - 1);
        double square = 0, weight = 1;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            std::array<int, 3> before = near, after = near;
            --before[axis];
            ++after[axis];
            const double along =
                (water_of(cloud, after) - water_of(cloud, before)) / (2 * cell_m[axis]);
            square += along * along;
            weight *= step[axis] == 0 ? 0.5 : 0.25;
        }
        sum += weight * std::sqrt(square);
    }
    return sum;
}

// The water of the wettest cell of a level.
double most_of(const GrownCloud& cloud, int z) {
    double most = -100;
    for (int i = 0; i < cloud.cells[0] * cloud.cells[1]; ++i) {
        most = std::max(most, water_of(cloud, {i % cloud.cells[0], i / cloud.cells[0], z}));
    }
    return most;
}

// A cloud of a tile of 60 m x 40 m x 50 m, whose detail is Worley noise with cells of 10 m.
config::Cloud cloud_with_relief(double relief) {
    config::Cloud cloud;
    cloud.extent = {config::Length{60}, config::Length{40}, config::Length{50}};
    cloud.detail_scale = {3, 2, 1};
    cloud.convection.relief = relief;
    return cloud;
}

config::Noise detail_noise(const std::string& type) {
    const auto recipe = config::parse_recipe(
        "[noise.n]\nsize = [8, 8, 8]\n[noise.n.channels.Y]\n" + type, "recipe");
    return recipe.value->parameters.noises.at(0);
}

const config::Noise& billows() {
    static const auto noise = detail_noise("type = 'worley'\nfrequency = [2, 2, 5]");
    return noise;
}

void expect_definition(const std::shared_ptr<GrownCloud>& cloud, const std::array<int, 3>& size,
                       double relief) {
    const config::Cloud keys = cloud_with_relief(relief);
    const std::array<double, 3> cell_m = {10, 10, 10};
    const double sharpness = 1 + std::min({size[0] / 6.0, size[1] / 4.0, size[2] / 5.0});
    const std::vector<float> values =
        filled(*volume_of_grown(cloud, keys, &billows(), size).source.voxels, {{}, size});
    const config::Noise detail =
        cloud_noise(billows(), keys.detail_scale, config::CloudChannels::density);
    for (int z = 0; z < size[2]; ++z) {
        for (int y = 0; y < size[1]; ++y) {
            for (int x = 0; x < size[0]; ++x) {
                const std::array<double, 3> place = {(x + 0.5) / size[0], (y + 0.5) / size[1],
                                                     (z + 0.5) / size[2]};
                const std::array<double, 3> at = {6 * place[0] - 0.5, 4 * place[1] - 0.5,
                                                  5 * place[2] - 0.5};
                const auto water_field = [&](const auto& cell) { return water_of(*cloud, cell); };
                const auto slope_field = [&](const auto& cell) {
                    return slope_of(*cloud, cell, cell_m);
                };
                const double noise = noise::noise_reference(detail, place)[0];
                const double moved_m = 10 * relief *
                                       std::min({1.0, 5 * place[2], 5 * (1 - place[2])}) *
                                       (2 * noise - 1);
                const double slope = between_cells(slope_field, {}, at, 3);
                const double moved = between_cells(water_field, {}, at, 3) + moved_m * slope;
                const auto level = static_cast<int>(std::floor(at[2]));
                const double most = std::max(most_of(*cloud, level), most_of(*cloud, level + 1));
                const double water = std::min({sharpness * moved, moved + 10 * slope, most});
                const auto i = static_cast<std::size_t>((z * size[1] + y) * size[0] + x);
                if (std::abs(water) < 1e-4) continue;  // the power is steep there
                ASSERT_NEAR(double{values[i]}, density(water, 2), 3e-6) << i;
            }
        }
    }
}

TEST(GrownVolume, IsCubicBetweenCells) {
    expect_definition(random_cloud({6, 4, 5}), {15, 9, 20}, 0);
}

TEST(GrownVolume, HasTheReliefOfItsNoise) {
    expect_definition(random_cloud({6, 4, 5}), {15, 9, 20}, 0.45);
    expect_definition(random_cloud({6, 4, 5}), {12, 8, 10}, 1);
}

// A front at 15.5 m, in cells of 1 m: water falls by 0.1 g/kg per metre along x, and rises again over the second
// half of the tile.
std::shared_ptr<GrownCloud> front() {
    auto cloud = std::make_shared<GrownCloud>();
    cloud->cells = {60, 4, 5};
    cloud->full_water = 100;
    for (int i = 0; i < 60 * 4 * 5; ++i) {
        cloud->water.push_back(0.1F * static_cast<float>(std::abs(i % 60 - 30) - 15));
    }
    return cloud;
}

TEST(GrownVolume, IsSteepAtAnEdge) {
    const std::array<int, 3> size = {600, 4, 5};
    const std::vector<float> row =
        filled(GrownVolume(front(), {1, 1, 1}, size), {{0, 0, 2}, {300, 1, 1}});
    const auto water = [&](std::size_t x) { return 100 * std::pow(double{row[x]}, 1.5); };
    EXPECT_EQ(row[155], 0) << "0.05 m outside";
    EXPECT_NEAR(water(154), 2 * 0.005, 1e-4) << "0.05 m within, in voxels of 1 m";
    EXPECT_NEAR(water(146), 2 * 0.085, 1e-4) << "0.85 m within";
    EXPECT_NEAR(water(144), 0.105 + 0.1, 1e-4) << "what lies 1 m deeper";
    EXPECT_NEAR(water(100), 0.545 + 0.1, 1e-4);
}

TEST(GrownVolume, NoiseMovesAFrontByMetres) {
    config::Cloud keys = cloud_with_relief(0.5);
    keys.extent[1] = config::Length{4};
    keys.extent[2] = config::Length{5};
    keys.detail_scale = {60, 4, 5};  // a noise without octaves counts as one billow a repeat: 1 m
    const std::array<int, 3> size = {600, 4, 5};
    const auto front_m = [&](const char* value, int z) {
        const config::Noise noise =
            detail_noise(std::string("type = 'constant'\nvalue = ") + value);
        const std::vector<float> row = filled(
            *volume_of_grown(front(), keys, &noise, size).source.voxels, {{0, 0, z}, {300, 1, 1}});
        return 0.1 * static_cast<double>(std::count_if(row.begin(), row.end(),
                                                       [](float value) { return value > 0; }));
    };
    EXPECT_NEAR(front_m("0.5", 2), 15.5, 0.1);
    EXPECT_NEAR(front_m("1", 2), 16, 0.1);
    EXPECT_NEAR(front_m("0.8", 2), 15.8, 0.1);
    EXPECT_NEAR(front_m("0", 2), 15, 0.1);
    EXPECT_NEAR(front_m("1", 0), 15.75, 0.1) << "half as far, half a metre above the base";
    EXPECT_NEAR(front_m("1", 4), 15.75, 0.1) << "half as far, half a metre below the top";
}

TEST(GrownVolume, LeavesOutOctavesThatVoxelsCannotShow) {
    const auto noise_of = [](const char* octaves) {
        return detail_noise(
            std::string("type = 'worley'\nfrequency = 1\nlacunarity = 4\noctaves = ") + octaves);
    };
    const auto made = [](const config::Noise& noise, const std::array<int, 3>& size) {
        const CloudVolume volume =
            volume_of_grown(random_cloud({6, 4, 5}), cloud_with_relief(0.5), &noise, size);
        return filled(*volume.source.voxels, {{}, size});
    };
    const config::Noise one = noise_of("1"), two = noise_of("2");
    EXPECT_EQ(made(one, {12, 8, 10}), made(two, {12, 8, 10}));
    EXPECT_NE(made(one, {48, 32, 16}), made(two, {48, 32, 16}));
}

void expect_equal_in_boxes(const VoxelSource& volume, const std::array<int, 3>& size) {
    const std::vector<float> all = filled(volume, {{}, size});
    int empty = 0;
    std::mt19937 random(2);
    for (int i = 0; i < 2000; ++i) {
        VoxelBox box;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto below = static_cast<unsigned>(size[axis]);
            box.origin[axis] = static_cast<int>(random() % below);
            box.size[axis] =
                1 + static_cast<int>(random() %
                                     std::min(3U, below - static_cast<unsigned>(box.origin[axis])));
        }
        ASSERT_TRUE(testing::is_part_of({all}, volume, size, box));
        if (!volume.is_empty(box)) continue;
        ++empty;
        ASSERT_EQ(std::ranges::max(filled(volume, box)), 0);
    }
    EXPECT_GT(empty, 0);
}

TEST(GrownVolume, DoesNotDependOnTheBox) {
    const std::array<int, 3> size = {15, 9, 20};
    // Mostly dry, so that many boxes are nearly empty.
    for (const double relief : {0.0, 0.1, 1.0}) {
        for (const double coverage : {0.7, 1.0, 1.1}) {
            const CloudVolume volume =
                volume_of_grown(random_cloud({6, 4, 5}, -1.5F), cloud_with_relief(relief),
                                &billows(), size, coverage);
            expect_equal_in_boxes(*volume.source.voxels, size);
        }
    }
}

TEST(GrownVolume, IsEmptyBelowAndAbove) {
    const GrownVolume volume(random_cloud({6, 4, 5}), {10, 10, 10}, {12, 8, 10});
    for (const int z : {-1, 10}) {
        EXPECT_EQ(filled(volume, {{3, 2, z}, {1, 1, 1}})[0], 0);
        EXPECT_TRUE(volume.is_empty({{0, 0, z}, {12, 8, 1}}));
    }
}

// A bake of fewer voxels than cells takes their means.
TEST(GrownVolume, OfFewVoxelsIsAMean) {
    const auto cloud = random_cloud({6, 4, 5});
    const CloudVolume volume = volume_of_grown(cloud, cloud_with_relief(0.5), nullptr, {3, 4, 10});
    EXPECT_EQ(volume.source.size, (std::array{6, 4, 10}));
    EXPECT_EQ(volume.source.voxel_size_m, (std::array{10.0, 10.0, 5.0}));
    const std::vector<float> fine = filled(*volume.source.voxels, {{}, {6, 4, 10}});
    const std::vector<float> coarse = filled(ResampledVolume(volume, {3, 4, 10}), {{}, {3, 4, 10}});
    for (std::size_t i = 0; i < coarse.size(); ++i) {
        EXPECT_NEAR(coarse[i], 0.5F * (fine[2 * i] + fine[2 * i + 1]), 1e-6F);
    }
}

}  // namespace
}  // namespace skybake::cloud
