// Volumes for tests of occupancy, held in memory.
#pragma once

#include <rapidcheck.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "bakers/field/pixel_type.h"
#include "bakers/occupancy/cell_grid.h"
#include "bakers/occupancy/occupied_cells.h"
#include "config/assets/occupancy_filter.h"
#include "config/sections/file_formats.h"
#include "tests/support/volumes.h"

namespace skybake::test {

using config::OccupancyFilter;
using occupancy::CellGrid;

inline constexpr std::array<OccupancyFilter, 3> kFilters = {
    OccupancyFilter::nearest, OccupancyFilter::trilinear, OccupancyFilter::tricubic};

struct Volume {
    CellGrid grid;
    std::vector<float> voxels;

    float& at(int x, int y, int z) { return voxels[occupancy::index_of(grid.voxels, x, y, z)]; }
    float at(int x, int y, int z) const {
        return voxels[occupancy::index_of(grid.voxels, x, y, z)];
    }
};

inline Volume volume_of(const CellGrid& grid, float value = 0) {
    return {grid, std::vector<float>(occupancy::count_of(grid.voxels), value)};
}

// A hash: 32 bits that differ for neighbours and seeds.
inline std::uint32_t mixed(std::uint32_t x) {
    x = (x ^ (x >> 16)) * 0x7feb352dU;
    x = (x ^ (x >> 15)) * 0x846ca68bU;
    return x ^ (x >> 16);
}

// In [0, 1), a multiple of 2^-24.
inline float share_of(std::uint32_t bits) { return static_cast<float>(bits >> 8) * 0x1p-24F; }

// Kinds of values that a volume may hold.
enum class Values {
    uniform,    // [0, 1)
    sparse,     // one in sixteen of them, else 0
    steps,      // multiples of 1/8: many equal ones, and means that are equal to voxels
    signs,      // (-1, 1)
    wide,       // magnitudes from 2^-60 to 2^20 and both signs: sums that double cannot hold
    denormals,  // down to the smallest
    constant
};

inline float value_of(Values values, std::uint32_t bits) {
    const float share = share_of(mixed(bits));
    switch (values) {
        case Values::uniform:
            return share;
        case Values::sparse:
            return bits % 16 == 0 ? share : 0;
        case Values::steps:
            return std::floor(share * 8) / 8;
        case Values::signs:
            return 2 * share - 1;
        case Values::wide:
            return std::ldexp(bits % 2 == 0 ? share : -share, static_cast<int>(bits % 57) - 36);
        case Values::denormals:
            return static_cast<float>(bits % 5) * 0x1p-149F;
        case Values::constant:
            return 0.7F;
    }
    return 0;
}

inline Volume any_volume(int largest_size, Values values, bool half = false) {
    CellGrid grid;
    for (int& size : grid.voxels) size = *rc::gen::inRange(1, largest_size + 1);
    grid.cell = *rc::gen::element(1, 2, 4, 8, 16);
    Volume volume = volume_of(grid);
    const auto seed = *rc::gen::arbitrary<std::uint32_t>();
    for (std::size_t i = 0; i < volume.voxels.size(); ++i) {
        volume.voxels[i] = value_of(values, mixed(seed + static_cast<std::uint32_t>(i)));
    }
    if (half && values != Values::wide) {  // halves cannot hold those
        round_values(volume.voxels.data(), volume.voxels.size(), config::PixelType::half);
    }
    return volume;
}

inline Values any_values() {
    return *rc::gen::element(Values::uniform, Values::sparse, Values::steps, Values::signs,
                             Values::wide, Values::denormals, Values::constant);
}

// The cells that the rule of the thesis calls occupied.
inline occupancy::OccupiedCells cells_of_thesis(const Volume& volume, float threshold) {
    const testing::FunctionVoxels source(
        [&](int x, int y, int z, int) { return volume.at(x, y, z); });
    return occupancy::occupied_cells_as_in_thesis({source, 0, 1}, volume.grid, threshold, {3});
}

// The filtered value at a place in voxel units.
inline double lookup(const Volume& volume, OccupancyFilter filter,
                     const std::array<double, 3>& place) {
    std::array<occupancy::AxisTaps, 3> taps;
    for (std::size_t a = 0; a < 3; ++a) {
        taps[a] = occupancy::filter_taps(filter, place[a], volume.grid.voxels[a], a < 2);
    }
    return occupancy::filtered_in_double(taps,
                                         [&](int x, int y, int z) { return volume.at(x, y, z); });
}

}  // namespace skybake::test
