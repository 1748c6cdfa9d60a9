// The voxels of a cloud that has grown, between the cells in which it grew.
#include "bakers/clouds/grown_volume.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace skybake::cloud {
namespace {

using convection::GrownCloud;

std::shared_ptr<GrownCloud> random_cloud(const std::array<int, 3>& cells) {
    std::mt19937 random(4);
    std::normal_distribution<float> number(-0.5F, 1);
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

TEST(GrownVolume, IsTheDensityOfItsCells) {
    const auto cloud = random_cloud({6, 4, 5});
    const std::vector<float> values = filled(GrownVolume(cloud, {6, 4, 5}), {{}, {6, 4, 5}});
    for (std::size_t i = 0; i < values.size(); ++i) {
        EXPECT_NEAR(double{values[i]}, density(double{cloud->water[i]}, 2), 1e-6);
    }
}

// Catmull and Rom's cubic in one dimension, in double precision.
double cubic(const std::array<double, 4>& p, double t) {
    const double value = p[1] + 0.5 * t *
                                    ((p[2] - p[0]) + t * ((2 * p[0] - 5 * p[1] + 4 * p[2] - p[3]) +
                                                          t * (3 * (p[1] - p[2]) + p[3] - p[0])));
    return std::clamp(value, std::min(p[1], p[2]), std::max(p[1], p[2]));
}

// Water at a place in cells, along the axes from x on.
double water_at(const GrownCloud& cloud, std::array<int, 3> cell, const std::array<double, 3>& at,
                int axes) {
    const auto& [nx, ny, nz] = cloud.cells;
    if (axes == 0) {
        const int x = (cell[0] + 2 * nx) % nx, y = (cell[1] + 2 * ny) % ny;
        const int z = std::clamp(cell[2], 0, nz - 1);
        return double{cloud.water[static_cast<std::size_t>((z * ny + y) * nx + x)]};
    }
    const auto axis = static_cast<std::size_t>(axes - 1);
    const int below = static_cast<int>(std::floor(at[axis]));
    std::array<double, 4> values{};
    for (int i = 0; i < 4; ++i) {
        cell[axis] = below - 1 + i;
        values[static_cast<std::size_t>(i)] = water_at(cloud, cell, at, axes - 1);
    }
    return cubic(values, at[axis] - below);
}

TEST(GrownVolume, IsCubicBetweenCells) {
    const auto cloud = random_cloud({6, 4, 5});
    const std::array<int, 3> size = {15, 9, 20};
    const std::vector<float> values = filled(GrownVolume(cloud, size), {{}, size});
    for (int z = 0; z < size[2]; ++z) {
        for (int y = 0; y < size[1]; ++y) {
            for (int x = 0; x < size[0]; ++x) {
                const std::array<double, 3> at = {(x + 0.5) * 6 / 15 - 0.5, (y + 0.5) * 4 / 9 - 0.5,
                                                  (z + 0.5) * 5 / 20 - 0.5};
                const double water = water_at(*cloud, {}, at, 3);
                const auto i = static_cast<std::size_t>((z * size[1] + y) * size[0] + x);
                if (std::abs(water) < 1e-4) continue;  // the power is steep there
                ASSERT_NEAR(double{values[i]}, density(water, 2), 3e-6)
                    << x << " " << y << " " << z;
            }
        }
    }
}

TEST(GrownVolume, DoesNotDependOnTheBox) {
    const auto cloud = random_cloud({6, 4, 5});
    const std::array<int, 3> size = {15, 9, 20};
    const GrownVolume volume(cloud, size);
    const std::vector<float> all = filled(volume, {{}, size});
    int empty = 0;
    std::mt19937 random(2);
    for (int i = 0; i < 200; ++i) {
        VoxelBox box;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto below = static_cast<unsigned>(size[axis]);
            box.origin[axis] = static_cast<int>(random() % below);
            box.size[axis] =
                1 + static_cast<int>(random() %
                                     std::min(3U, below - static_cast<unsigned>(box.origin[axis])));
        }
        const std::vector<float> part = filled(volume, box);
        std::size_t at = 0;
        float greatest = 0;
        for (int z = box.origin[2]; z < box.origin[2] + box.size[2]; ++z) {
            for (int y = box.origin[1]; y < box.origin[1] + box.size[1]; ++y) {
                for (int x = box.origin[0]; x < box.origin[0] + box.size[0]; ++x, ++at) {
                    ASSERT_EQ(part[at],
                              all[static_cast<std::size_t>((z * size[1] + y) * size[0] + x)]);
                    greatest = std::max(greatest, part[at]);
                }
            }
        }
        if (!volume.is_empty(box)) continue;
        ++empty;
        ASSERT_EQ(greatest, 0);
    }
    EXPECT_GT(empty, 0);
}

TEST(GrownVolume, IsEmptyBelowAndAbove) {
    const GrownVolume volume(random_cloud({6, 4, 5}), {12, 8, 10});
    for (const int z : {-1, 10}) {
        EXPECT_EQ(filled(volume, {{3, 2, z}, {1, 1, 1}})[0], 0);
        EXPECT_TRUE(volume.is_empty({{0, 0, z}, {12, 8, 1}}));
    }
}

// A bake of fewer voxels than cells takes their means.
TEST(GrownVolume, OfFewVoxelsIsAMean) {
    const auto cloud = random_cloud({6, 4, 5});
    config::Cloud extent;
    extent.extent = {config::Length{60}, config::Length{40}, config::Length{50}};
    const CloudVolume volume = volume_of_grown(cloud, extent, {3, 4, 10});
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
