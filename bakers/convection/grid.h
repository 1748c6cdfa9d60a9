// Fields on the cells of a box that repeats along x and y.
//
// Velocities lie on the lower faces of their cells (Harlow and Welch 1965, "Numerical calculation of
// time-dependent viscous incompressible flow of fluid with free surface"), all else at the centres. Rows
// run along x and have a margin on both sides that holds the row's other end, so that kernels read
// straight on; y wraps through row numbers; below the floor and above the lid the nearest level is read.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "bakers/math/parallel.h"

namespace skybake::convection {

constexpr int kMargin = 4;  // cells beyond each end of a row; the widest stencil reads 3

struct Grid {
    std::array<int, 3> cells{};     // along x, y, z
    std::array<float, 3> edge_m{};  // of a cell
    bool operator==(const Grid&) const = default;
    int stride() const { return cells[0] + 2 * kMargin; }
    std::size_t plane() const {
        return static_cast<std::size_t>(stride()) * static_cast<std::size_t>(cells[1]);
    }
};

class Field {
  public:
    explicit Field(const Grid& grid)
        : grid_(grid), values_(grid.plane() * static_cast<std::size_t>(grid.cells[2]), 0.0F) {}

    // The first cell of row y of level z; y wraps, and z stops at the outermost levels.
    float* row(int y, int z) { return values_.data() + offset(y, z); }
    const float* row(int y, int z) const { return values_.data() + offset(y, z); }

    // Fills the margins of a row from its cells.
    void wrap(int y, int z) {
        float* cells = row(y, z);
        const int n = grid_.cells[0];
        for (int i = 1; i <= kMargin; ++i) {
            cells[-i] = cells[n - 1 - (i - 1) % n];
            cells[n - 1 + i] = cells[(i - 1) % n];
        }
    }

    void swap(Field& other) { values_.swap(other.values_); }

  private:
    std::size_t offset(int y, int z) const {
        const int inside = std::clamp(z, 0, grid_.cells[2] - 1);
        const int rows = grid_.cells[1];
        const int wrapped = (y + 2 * rows) % rows;
        return static_cast<std::size_t>(inside) * grid_.plane() +
               static_cast<std::size_t>(wrapped) * static_cast<std::size_t>(grid_.stride()) +
               kMargin;
    }

    Grid grid_;
    std::vector<float> values_;
};

// The flow at a moment. Vertical velocity is 0 on the floor, which is level 0, and on the lid.
struct State {
    explicit State(const Grid& grid)
        : velocity{Field(grid), Field(grid), Field(grid)}, heat(grid), water(grid) {}
    std::array<Field, 3> velocity;  // m/s
    Field heat;                     // liquid-water potential temperature less kReference, K
    Field water;                    // vapour and droplets, g/kg
};

// Calls work(z) for all levels, on several threads.
inline void each_level(const Grid& grid, int threads, const std::function<void(int)>& work) {
    parallel_for(grid.cells[2], threads, work);
}

}  // namespace skybake::convection
