// Fields for tests of the flow.
#pragma once

#include <algorithm>
#include <random>
#include <vector>

#include "bakers/convection/grid.h"
#include "bakers/convection/sounding.h"

namespace skybake::convection::test {

// Calls visit(value, x, y, z) for all cells, and fills the margins again.
template <class Visit>
void each_cell(const Grid& grid, Field& field, const Visit& visit) {
    for (int z = 0; z < grid.cells[2]; ++z) {
        for (int y = 0; y < grid.cells[1]; ++y) {
            for (int x = 0; x < grid.cells[0]; ++x) visit(field.row(y, z)[x], x, y, z);
            field.wrap(y, z);
        }
    }
}

inline void fill_at_random(const Grid& grid, std::mt19937& random, Field& field) {
    std::uniform_real_distribution<float> number(-1, 1);
    each_cell(grid, field, [&](float& value, int, int, int) { value = number(random); });
}

// The vertical wind at the lower face of a cell; 0 on the lid.
inline float lifted(const Grid& grid, const Field& wind, int x, int y, int z) {
    return z < grid.cells[2] ? wind.row(y, z)[x] : 0;
}

// The largest outflow of a cell over its volume, 1/s.
inline double largest_divergence(const Grid& grid, const std::array<Field, 3>& wind) {
    double largest = 0;
    for (int z = 0; z < grid.cells[2]; ++z) {
        for (int y = 0; y < grid.cells[1]; ++y) {
            for (int x = 0; x < grid.cells[0]; ++x) {
                const double along_x = wind[0].row(y, z)[x + 1] - wind[0].row(y, z)[x];
                const double along_y = wind[1].row(y + 1, z)[x] - wind[1].row(y, z)[x];
                const double along_z =
                    lifted(grid, wind[2], x, y, z + 1) - lifted(grid, wind[2], x, y, z);
                largest =
                    std::max(largest, std::abs(along_x / grid.edge_m[0] + along_y / grid.edge_m[1] +
                                               along_z / grid.edge_m[2]));
            }
        }
    }
    return largest;
}

// A random wind without divergence.
inline std::array<Field, 3> random_wind(const Grid& grid, unsigned seed) {
    std::mt19937 random(seed);
    std::array<Field, 3> wind = {Field(grid), Field(grid), Field(grid)};
    for (Field& part : wind) fill_at_random(grid, random, part);
    for (int y = 0; y < grid.cells[1]; ++y) {
        std::fill_n(wind[2].row(y, 0) - kMargin, grid.stride(), 0.0F);
    }
    return wind;
}

// A small tile in which clouds grow within minutes.
// The cloudy levels of a flow: all rows of what `row` writes.
template <class Row>
std::vector<float> rows_of(const Specification& wanted, const Row& row) {
    const auto [nx, ny, nz] = wanted.grid.cells;
    std::vector<float> all;
    for (int z = wanted.mixed_levels; z < nz - wanted.sponge_levels; ++z) {
        for (int y = 0; y < ny; ++y) {
            all.resize(all.size() + static_cast<std::size_t>(nx));
            row(y, z, all.data() + all.size() - nx);
        }
    }
    return all;
}

inline Specification small() {
    Specification wanted;
    wanted.grid = {{24, 20, 30}, {60, 60, 60}};
    wanted.mixed_levels = 8;
    wanted.inversion_m = 900;
    wanted.wind_top_m_per_s = {4, -2};
    wanted.patches = 3;
    wanted.growth_s = 600;
    return wanted;
}

}  // namespace skybake::convection::test
