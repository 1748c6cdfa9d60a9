// Transport against its formulas in double precision, cell by cell, and its order.
#include "bakers/convection/transport.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "bakers/convection/projection.h"
#include "tests/convection/fields.h"

namespace skybake::convection {
namespace {

using test::each_cell;
using test::fill_at_random;
using test::random_wind;

constexpr Grid kGrid{{12, 10, 11}, {40, 30, 20}};

// Six values across a face, along the wind.
using Stencil = std::array<double, 6>;

double upwind_value(const Stencil& q) {
    return (2 * q[0] - 13 * q[1] + 47 * q[2] + 27 * q[3] - 3 * q[4]) / 60;
}

// Borges et al. 2008, equations 8 to 10 and 28, with p = 1.
double weighted_value(const Stencil& q) {
    const std::array<double, 3> values = {(2 * q[0] - 7 * q[1] + 11 * q[2]) / 6,
                                          (-q[1] + 5 * q[2] + 2 * q[3]) / 6,
                                          (2 * q[2] + 5 * q[3] - q[4]) / 6};
    const auto square = [](double x) { return x * x; };
    std::array<double, 3> rough = {
        13.0 / 12 * square(q[0] - 2 * q[1] + q[2]) + 0.25 * square(q[0] - 4 * q[1] + 3 * q[2]),
        13.0 / 12 * square(q[1] - 2 * q[2] + q[3]) + 0.25 * square(q[1] - q[3]),
        13.0 / 12 * square(q[2] - 2 * q[3] + q[4]) + 0.25 * square(3 * q[2] - 4 * q[3] + q[4])};
    const double spread = std::abs(rough[0] - rough[2]);
    constexpr std::array<double, 3> kIdeal = {0.1, 0.6, 0.3};
    double sum = 0, weights = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const double weight = kIdeal[k] * (1 + spread / (rough[k] + 0.25e-6));
        sum += weight * values[k];
        weights += weight;
    }
    return sum / weights;
}

// A field and its winds, of which cells beyond the walls are known.
struct Reference {
    const Grid& grid;
    const std::array<Field, 3>& wind;
    const Field& field;
    int shifted = 3;

    int wrapped(int i, std::size_t axis) const { return (i + grid.cells[axis]) % grid.cells[axis]; }
    double cell(std::array<int, 3> at) const {
        if (at[2] >= grid.cells[2] && shifted == 2) return 0;
        return field.row(wrapped(at[1], 1), at[2])[wrapped(at[0], 0)];
    }
    double wind_at(std::size_t axis, const std::array<int, 3>& at) const {
        if (axis == 2 && (at[2] <= 0 || at[2] >= grid.cells[2])) return 0;
        return wind[axis].row(wrapped(at[1], 1), at[2])[wrapped(at[0], 0)];
    }
    // The flux through the lower face along an axis.
    double flux(std::size_t axis, std::array<int, 3> at, bool weighted) const {
        std::array<int, 3> before = at;
        if (shifted < 3) --before[static_cast<std::size_t>(shifted)];
        const double speed = 0.5 * (wind_at(axis, at) + wind_at(axis, before));
        Stencil across{};
        for (int i = 0; i < 6; ++i) {
            std::array<int, 3> place = at;
            place[axis] += speed >= 0 ? i - 3 : 2 - i;
            across[static_cast<std::size_t>(i)] = cell(place);
        }
        return speed * (weighted ? weighted_value(across) : upwind_value(across));
    }
    double tendency(const std::array<int, 3>& at, bool weighted) const {
        double sum = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            std::array<int, 3> next = at;
            ++next[axis];
            sum += (flux(axis, at, weighted) - flux(axis, next, weighted)) / grid.edge_m[axis];
        }
        return sum;
    }
};

TEST(Transport, IsItsFormulasCellByCell) {
    std::array<Field, 3> wind = random_wind(kGrid, 7);
    std::mt19937 random(8);
    Field scalar(kGrid), base(kGrid), made(kGrid);
    fill_at_random(kGrid, random, scalar);
    fill_at_random(kGrid, random, base);
    for (int shifted = 0; shifted <= 3; ++shifted) {
        for (const Flux flux : {Flux::upwind, Flux::weighted}) {
            const Field& from = shifted == 3 ? scalar : wind[static_cast<std::size_t>(shifted)];
            const Transport what{wind, from, base, shifted, flux, 5};
            // In two parts, as threads take them.
            transport(kGrid, what, 0, 4, made);
            transport(kGrid, what, 4, kGrid.cells[2], made);
            const Reference reference{kGrid, wind, from, shifted};
            each_cell(kGrid, made, [&](float value, int x, int y, int z) {
                if (shifted == 2 && z == 0) return;  // the floor
                const double expected =
                    base.row(y, z)[x] + 5 * reference.tendency({x, y, z}, flux == Flux::weighted);
                ASSERT_NEAR(double{value}, expected, 2e-5)
                    << shifted << " at " << x << ", " << y << ", " << z;
            });
        }
    }
}

double sum_of(const Grid& grid, Field& field) {
    double sum = 0;
    each_cell(grid, field, [&](float value, int, int, int) { sum += double{value}; });
    return sum;
}

TEST(Transport, KeepsTotals) {
    const std::array<Field, 3> wind = random_wind(kGrid, 9);
    std::mt19937 random(10);
    Field field(kGrid), next(kGrid);
    fill_at_random(kGrid, random, field);
    const double before = sum_of(kGrid, field);
    for (const Flux flux : {Flux::upwind, Flux::weighted}) {
        transport(kGrid, {wind, field, field, 3, flux, 10}, 0, kGrid.cells[2], next);
        EXPECT_NEAR(sum_of(kGrid, next), before, 1e-4);
    }
}

// The error of a wave's tendency in a steady wind along an axis.
double wave_error(int cells, Flux flux, std::size_t axis) {
    Grid grid{{8, 8, 8}, {1, 1, 1}};
    grid.cells[axis] = cells;
    grid.edge_m[axis] = 1 / static_cast<float>(cells);
    std::array<Field, 3> wind = {Field(grid), Field(grid), Field(grid)};
    each_cell(grid, wind[axis], [](float& value, int, int, int) { value = 1; });
    Field field(grid), still(grid), made(grid);
    const auto turn = [&](const std::array<int, 3>& at) {
        return 2 * std::numbers::pi * (at[axis] + 0.5) / cells;
    };
    each_cell(grid, field, [&](float& value, int x, int y, int z) {
        // Means over cells, which fluxes change exactly.
        const double half = std::numbers::pi / cells;
        value = static_cast<float>(std::sin(turn({x, y, z})) * std::sin(half) / half);
    });
    transport(grid, {wind, field, still, 3, flux, 1}, 0, grid.cells[2], made);
    double largest = 0;
    each_cell(grid, made, [&](float value, int x, int y, int z) {
        const double half = std::numbers::pi / cells;
        const double exact =
            -2 * std::numbers::pi * std::cos(turn({x, y, z})) * std::sin(half) / half;
        largest = std::max(largest, std::abs(double{value} - exact));
    });
    return largest;
}

TEST(Transport, IsOfFifthOrder) {
    for (const Flux flux : {Flux::upwind, Flux::weighted}) {
        for (const std::size_t axis : {0, 1}) {
            const double ratio = wave_error(12, flux, axis) / wave_error(24, flux, axis);
            EXPECT_GT(ratio, 24) << axis;
            EXPECT_LT(ratio, 64) << axis;
        }
    }
}

}  // namespace
}  // namespace skybake::convection
