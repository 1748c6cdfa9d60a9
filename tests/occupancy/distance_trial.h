// Textures of distances to small clouds, with all that they are made from.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "bakers/assets/cloud_distance/distance_check.h"
#include "bakers/math/quadrature.h"
#include "bakers/occupancy/distance_volume.h"
#include "bakers/occupancy/stored_distance.h"
#include "config/assets/cloud_distance.h"
#include "tests/occupancy/volumes_in_memory.h"
#include "tests/support/volumes.h"

namespace skybake::test {

using config::DistanceContent;
using Point = std::array<double, 3>;

inline occupancy::VoxelBits bits_of(const Volume& volume, float threshold) {
    occupancy::VoxelBits bits(volume.grid.voxels);
    for (int z = 0; z < volume.grid.voxels[2]; ++z) {
        for (int y = 0; y < volume.grid.voxels[1]; ++y) {
            bits.set_row(y, z, &volume.voxels[occupancy::index_of(volume.grid.voxels, 0, y, z)],
                         threshold);
        }
    }
    return bits;
}

// Balls of cloud, denser inside, in a tile that they may stick out of.
inline Volume balls(const CellGrid& grid, std::uint32_t seed, int count, double radius) {
    Volume volume = volume_of(grid);
    for (int ball = 0; ball < count; ++ball) {
        Point centre{};
        for (std::size_t a = 0; a < 3; ++a) {
            const auto bits =
                seed + 31U * static_cast<std::uint32_t>(ball) + static_cast<std::uint32_t>(a);
            centre[a] = double{share_of(mixed(bits))} * grid.voxels[a];
        }
        testing::for_each_voxel(grid.voxels, [&](int x, int y, int z) {
            const Point at = {x + 0.5, y + 0.5, z + 0.5};
            double square = 0;
            for (std::size_t a = 0; a < 3; ++a) {
                double way = std::fabs(at[a] - centre[a]);
                if (a < 2) way = std::min(way, grid.voxels[a] - way);
                square += way * way;
            }
            const auto density = static_cast<float>(1 - std::sqrt(square) / radius);
            volume.at(x, y, z) = std::max(volume.at(x, y, z), density);
        });
    }
    return volume;
}

// A texture of distances, and all that it was made from.
struct DistanceTrial {
    DistanceTrial(const Volume& from, const Point& edges, PixelType type = PixelType::unorm16,
                  float from_threshold = 0, std::array<double, 2> range = {-256, 4096})
        : volume(from),
          voxel_m(edges),
          threshold(from_threshold),
          code(range,
               {edges[0] * from.grid.cell, edges[1] * from.grid.cell, edges[2] * from.grid.cell},
               type),
          bits(bits_of(volume, threshold)),
          texels(bits, {volume.grid, voxel_m}, code, {DistanceContent::distance}, {}, {}),
          values(texels.distances()) {}

    occupancy::DistanceCheckResult check(int points = 3000) const {
        const occupancy::NearestVoxel nearest(bits, voxel_m);
        return occupancy::check_distances({volume.grid.size(), values.data(), volume.grid.cell},
                                          code, nearest, volume.grid.voxels, voxel_m, points, 300,
                                          {});
    }
    // In metres at a place in voxels.
    double look_up(const Point& place) const {
        std::array<occupancy::AxisTaps, 3> taps;
        for (std::size_t a = 0; a < 3; ++a) {
            taps[a] =
                occupancy::filter_taps(config::OccupancyFilter::trilinear,
                                       place[a] / volume.grid.cell, volume.grid.size()[a], a < 2);
        }
        return code.metres(occupancy::filtered_in_double(taps, [&](int x, int y, int z) {
            return values[occupancy::index_of(volume.grid.size(), x, y, z)];
        }));
    }
    bool is_cloud(const Point& place) const {
        return lookup(volume, config::OccupancyFilter::trilinear, place) > double{threshold};
    }

    Volume volume;
    Point voxel_m;
    float threshold;
    occupancy::DistanceCode code;
    occupancy::VoxelBits bits;
    occupancy::DistanceSource texels;
    std::vector<float> values;
};

// Rays through a field of small clouds, each step of which is sampled at every quarter of a voxel.
inline std::int64_t steps_that_lose(const DistanceTrial& trial, int rays, std::int64_t& steps) {
    const std::array<int, 3>& size = trial.volume.grid.voxels;
    std::int64_t lost = 0;
    for (int ray = 0; ray < rays; ++ray) {
        Point at = low_discrepancy_point(ray);
        for (std::size_t a = 0; a < 3; ++a) at[a] *= size[a];
        const Point share = low_discrepancy_point(ray + (1 << 21));
        const double cosine = 2 * share[0] - 1;
        const double sine = std::sqrt(1 - cosine * cosine);
        const Point way = {sine * std::cos(6.2831853 * share[1]) / trial.voxel_m[0],
                           sine * std::sin(6.2831853 * share[1]) / trial.voxel_m[1],
                           cosine / trial.voxel_m[2]};
        for (int step = 0; step < 64 && at[2] >= 0 && at[2] <= size[2]; ++step) {
            const double distance = trial.look_up(at);
            if (distance <= 0.1) break;
            ++steps;
            const int samples =
                static_cast<int>(4 * distance /
                                 *std::min_element(trial.voxel_m.begin(), trial.voxel_m.end())) +
                1;
            bool lose = false;
            for (int i = 0; i <= samples && !lose; ++i) {
                Point sample = at;
                for (std::size_t a = 0; a < 3; ++a) sample[a] += distance * i / samples * way[a];
                lose = sample[2] >= 0 && sample[2] <= size[2] && trial.is_cloud(sample);
            }
            lost += lose ? 1 : 0;
            for (std::size_t a = 0; a < 3; ++a) at[a] += distance * way[a];
        }
    }
    return lost;
}

inline DistanceTrial field(PixelType type = PixelType::unorm16) {
    return {balls({{48, 40, 26}, 2}, 5, 4, 5), {25, 20, 30}, type};
}

}  // namespace skybake::test
