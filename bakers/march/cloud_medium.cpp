#include "bakers/march/cloud_medium.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "bakers/math/parallel.h"
#include "bakers/occupancy/cell_range.h"
#include "bakers/occupancy/leap_distance.h"
#include "bakers/occupancy/occupied_cells.h"
#include "config/assets/occupancy_filter.h"

namespace skybake {
namespace {

using occupancy::CellGrid;

// The reach in an empty volume, which is farther than any ray goes.
constexpr float kNothingAtAll = 0x1p30F;

float visible_above(const CloudOptics& optics, const PaddedVolume& volume) {
    float least = 0;
    float greatest = 0;
    for (const float value : volume.values) {
        least = std::min(least, value);
        greatest = std::max(greatest, std::fabs(value));
    }
    const auto threshold = static_cast<float>(optics.has_edge ? optics.threshold : 0.0);
    if (threshold == 0 && least == 0) return 0;
    return std::nextafter(threshold + 0x1p-20F * greatest, 0x1p127F);
}

// Returns the least number of voxels in `steps` consecutive cells of a repeating axis.
int voxels_of_cells(int steps, int cell, int cells, int size) {
    const int missing = cells * cell - size;  // of the last cell
    return steps * cell - (steps + cells - 1) / cells * missing;
}

}  // namespace

PaddedVolume padded_volume(const float* voxels, const std::array<int, 3>& size, int channel,
                           int channels, int threads, bool repeats) {
    PaddedVolume padded;
    padded.size = size;
    padded.values.resize(static_cast<std::size_t>(padded.plane()) *
                         static_cast<std::size_t>(size[2] + 2));
    parallel_for(size[2] + 2, threads, [&](int plane) {
        const int z = occupancy::clamped(plane - 1, size[2]);
        float* out = padded.values.data() + plane * padded.plane();
        for (int row = 0; row < size[1] + 2; ++row) {
            const int y = occupancy::wrapped(row - 1, size[1]);
            if (!repeats && y != row - 1) {  // the padding stays 0
                out += padded.row();
                continue;
            }
            const auto at = [&](int x) {
                return voxels[occupancy::index_of(size, x, y, z) *
                                  static_cast<std::size_t>(channels) +
                              static_cast<std::size_t>(channel)];
            };
            *out++ = repeats ? at(size[0] - 1) : 0;
            for (int x = 0; x < size[0]; ++x) *out++ = at(x);
            *out++ = repeats ? at(0) : 0;
        }
    });
    return padded;
}

LeapGrid leap_grid(const std::array<int, 3>& voxels, int cell, const std::vector<float>& leaps) {
    LeapGrid grid;
    grid.cell = cell;
    grid.cells = CellGrid{voxels, cell}.size();
    grid.reach.reserve(leaps.size());
    const bool nothing = std::ranges::none_of(leaps, [](float l) { return l == 0; });
    for (const float leap : leaps) {
        if (leap == 0) {
            grid.reach.push_back(-1);
            continue;
        }
        const int steps = static_cast<int>(leap) - 1;
        const int reach = std::min(voxels_of_cells(steps, cell, grid.cells[0], voxels[0]),
                                   voxels_of_cells(steps, cell, grid.cells[1], voxels[1]));
        grid.reach.push_back(nothing ? kNothingAtAll : static_cast<float>(reach));
    }
    return grid;
}

CloudMedium cloud_medium(const Cloud& cloud, const float* voxels, const std::array<int, 3>& size,
                         int channels, int threads, bool repeats) {
    CloudMedium medium;
    for (std::size_t a = 0; a < 3; ++a) medium.extent_m[a] = cloud.extent[a].meters;
    medium.base_m = cloud.base_altitude.meters;
    medium.optics = cloud_optics(cloud);
    medium.repeats = repeats;
    medium.volume = padded_volume(voxels, size, 0, channels, threads, repeats);
    medium.visible_above = visible_above(medium.optics, medium.volume);
    const std::vector<float> all_occupied(occupancy::count_of(CellGrid{size, 16}.size()), 0.0F);
    medium.leaps = leap_grid(size, 16, all_occupied);
    return medium;
}

double mean_density(const CloudMedium& medium, const VoxelBlocks& blocks, int i, int j, int k) {
    double sum = 0;
    int count = 0;
    for (int z = blocks.first(2, k); z < blocks.first(2, k + 1); ++z) {
        for (int y = blocks.first(1, j); y < blocks.first(1, j + 1); ++y) {
            const float* row = medium.volume.values.data() + (z + 1) * medium.volume.plane() +
                               (y + 1) * medium.volume.row() + 1;
            for (int x = blocks.first(0, i); x < blocks.first(0, i + 1); ++x) {
                sum += density(medium.optics, double{row[x]});
                ++count;
            }
        }
    }
    return sum / count;
}

CloudMedium coarse_medium(const CloudMedium& medium, const std::array<int, 3>& block, int threads) {
    const VoxelBlocks blocks(medium.volume.size, block);
    std::vector<float> means(occupancy::count_of(blocks.size));
    parallel_for(blocks.size[2], threads, [&](int z) {
        for (int y = 0; y < blocks.size[1]; ++y) {
            for (int x = 0; x < blocks.size[0]; ++x) {
                means[occupancy::index_of(blocks.size, x, y, z)] =
                    static_cast<float>(mean_density(medium, blocks, x, y, z));
            }
        }
    });
    CloudMedium coarse;
    coarse.extent_m = medium.extent_m;
    coarse.base_m = medium.base_m;
    coarse.repeats = medium.repeats;
    coarse.optics.extinction_per_m = medium.optics.extinction_per_m;
    coarse.volume = padded_volume(means.data(), blocks.size, 0, 1, threads, medium.repeats);
    coarse.variation = medium.variation;
    const auto scaled = [&](std::size_t axis, float& voxels) {
        voxels *= static_cast<float>(blocks.size[axis]) / static_cast<float>(blocks.voxels[axis]);
    };
    for (float& shift : coarse.variation.shift_x) scaled(0, shift);
    for (float& shift : coarse.variation.shift_y) scaled(1, shift);
    scaled(0, coarse.variation.margin_x);
    scaled(1, coarse.variation.margin_y);
    coarse.variation.greatest = *std::ranges::max_element(means);
    return coarse;
}

TileVariation varied_tiles(const CloudMedium& medium) {
    // The margin's share of a tile's edge, on each side of a border.
    constexpr float kMargin = 0.125F;
    const std::array<int, 3>& size = medium.volume.size;
    TileVariation variation;
    std::mt19937_64 random;
    for (int tile = 0; tile < kVariedTiles * kVariedTiles; ++tile) {
        const std::uint64_t bits = random();
        variation.shift_x.push_back(
            static_cast<float>((bits & 0xffffffff) % static_cast<std::uint64_t>(size[0])));
        variation.shift_y.push_back(
            static_cast<float>((bits >> 32) % static_cast<std::uint64_t>(size[1])));
    }
    variation.shift_x.front() = 0;
    variation.shift_y.front() = 0;
    variation.margin_x = kMargin * static_cast<float>(size[0]);
    variation.margin_y = kMargin * static_cast<float>(size[1]);
    for (const float value : medium.volume.values) {
        variation.greatest = std::max(variation.greatest, std::fabs(value));
    }
    return variation;
}

LeapGrid leaps_of_voxels(const CloudMedium& medium, int cell, int threads) {
    const std::array<int, 3>& size = medium.volume.size;
    const CellGrid grid{size, cell};
    std::vector<float> voxels(occupancy::count_of(size));
    parallel_for(size[2], threads, [&](int z) {
        for (int y = 0; y < size[1]; ++y) {
            const float* row = medium.volume.values.data() + (z + 1) * medium.volume.plane() +
                               (y + 1) * medium.volume.row() + 1;
            std::copy(row, row + size[0], voxels.data() + occupancy::index_of(size, 0, y, z));
        }
    });
    const auto ranges =
        occupancy::cell_ranges(voxels.data(), grid, config::OccupancyFilter::trilinear, threads);
    const auto threshold =
        static_cast<float>(medium.optics.has_edge ? medium.optics.threshold : 0.0);
    const auto leaps = occupancy::leap_distance(occupancy::occupied_cells(ranges, threshold));
    return leap_grid(size, cell, {leaps.begin(), leaps.end()});
}

}  // namespace skybake
