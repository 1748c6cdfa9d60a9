#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/convection/projection.cpp"
#include <hwy/foreach_target.h>
// Highway wants its own header after foreach_target.h.
#include <hwy/highway.h>

#include "bakers/convection/projection.h"
#include "bakers/math/transcendental.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::convection::HWY_NAMESPACE {

// A level of the elimination of -below p(z - 1) + diagonal p(z) - above p(z + 1) = right hand side.
void Eliminate(const float* __restrict eigenvalue, float eigenvalue_y, float below, float above,
               int count, const float* __restrict factor_below, const float* __restrict value_below,
               float* __restrict factor, float* __restrict value) {
    for (int i = 0; i < count; ++i) {
        const float diagonal = (eigenvalue[i] + eigenvalue_y) + (below + above);
        const float pivot = diagonal - below * factor_below[i];
        factor[i] = above / pivot;
        value[i] = (below * value_below[i] - value[i]) / pivot;
    }
}

void Substitute(const float* __restrict factor, const float* __restrict above, int count,
                float* __restrict value) {
    for (int i = 0; i < count; ++i) value[i] = value[i] + factor[i] * above[i];
}

void Diverge(const float* __restrict u, const float* __restrict v, const float* __restrict v_next,
             const float* __restrict w, const float* __restrict w_above, const float* inverse,
             int count, float* __restrict out) {
    for (int i = 0; i < count; ++i) {
        out[i] = ((u[i + 1] - u[i]) * inverse[0] + (v_next[i] - v[i]) * inverse[1]) +
                 (w_above[i] - w[i]) * inverse[2];
    }
}

void Subtract(const float* __restrict pressure, const float* __restrict before, float inverse,
              int count, float* __restrict velocity) {
    for (int i = 0; i < count; ++i) velocity[i] = velocity[i] - (pressure[i] - before[i]) * inverse;
}

}  // namespace skybake::convection::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skybake::convection {

HWY_EXPORT(Eliminate);
HWY_EXPORT(Substitute);
HWY_EXPORT(Diverge);
HWY_EXPORT(Subtract);

namespace {

// The eigenvalues of less the second difference around a circle are (2 - 2 cos(2 pi k / n)) / edge^2.
std::vector<float> eigenvalues(int n, float edge_m) {
    std::vector<float> values;
    for (int k = 0; k < n; ++k) {
        const double cosine = cosine_of_turns(static_cast<double>(k) / n);
        values.push_back(static_cast<float>(2 * (1 - cosine) / (double{edge_m} * double{edge_m})));
    }
    return values;
}

}  // namespace

Projection::Projection(const Grid& grid)
    : grid_(grid),
      hartley_(grid.cells[0], grid.cells[1]),
      area_(static_cast<std::size_t>(grid.cells[0]) * static_cast<std::size_t>(grid.cells[1])),
      values_(area_ * static_cast<std::size_t>(grid.cells[2])),
      factors_(values_.size()),
      eigenvalues_{eigenvalues(grid.cells[0], grid.edge_m[0]),
                   eigenvalues(grid.cells[1], grid.edge_m[1])} {}

void Projection::set_divergence(const std::array<Field, 3>& velocity, int z) {
    const std::array<float, 3> inverse = {1 / grid_.edge_m[0], 1 / grid_.edge_m[1],
                                          1 / grid_.edge_m[2]};
    const std::vector<float> lid(static_cast<std::size_t>(grid_.cells[0]), 0.0F);
    for (int y = 0; y < grid_.cells[1]; ++y) {
        const bool is_top = z + 1 == grid_.cells[2];
        HWY_DYNAMIC_DISPATCH(Diverge)
        (velocity[0].row(y, z), velocity[1].row(y, z), velocity[1].row(y + 1, z),
         velocity[2].row(y, z), is_top ? lid.data() : velocity[2].row(y, z + 1), inverse.data(),
         grid_.cells[0], plane(z) + y * grid_.cells[0]);
    }
}

// The waves of row y, but for the one without waves.
void Projection::solve_columns(int y) {
    const int count = grid_.cells[0];
    const int levels = grid_.cells[2];
    const float step = 1 / (grid_.edge_m[2] * grid_.edge_m[2]);
    const std::vector<float> nothing(static_cast<std::size_t>(count), 0.0F);
    const std::size_t row = static_cast<std::size_t>(y) * static_cast<std::size_t>(count);
    const auto factor = [&](int z) {
        return factors_.data() + static_cast<std::size_t>(z) * area_ + row;
    };
    for (int z = 0; z < levels; ++z) {
        HWY_DYNAMIC_DISPATCH(Eliminate)
        (eigenvalues_[0].data(), eigenvalues_[1][static_cast<std::size_t>(y)], z > 0 ? step : 0,
         z + 1 < levels ? step : 0, count, z > 0 ? factor(z - 1) : nothing.data(),
         z > 0 ? plane(z - 1) + row : nothing.data(), factor(z), plane(z) + row);
    }
    for (int z = levels - 2; z >= 0; --z) {
        HWY_DYNAMIC_DISPATCH(Substitute)(factor(z), plane(z + 1) + row, count, plane(z) + row);
    }
}

// The mean of each level: its pressure stops the mean vertical wind. Its own constant is free.
void Projection::solve_mean_column() {
    double wind = 0;
    double pressure = 0;
    for (int z = 0; z < grid_.cells[2]; ++z) {
        wind += double{*plane(z)} * double{grid_.edge_m[2]};
        *plane(z) = static_cast<float>(pressure);
        pressure += wind * double{grid_.edge_m[2]};
    }
}

void Projection::subtract_gradient(std::array<Field, 3>& velocity, int z) {
    const int count = grid_.cells[0];
    std::vector<float> shifted(static_cast<std::size_t>(count));
    for (int y = 0; y < grid_.cells[1]; ++y) {
        const float* own = plane(z) + y * count;
        const float* south = plane(z) + (y + grid_.cells[1] - 1) % grid_.cells[1] * count;
        std::copy_n(own, count - 1, shifted.data() + 1);
        shifted[0] = own[count - 1];
        HWY_DYNAMIC_DISPATCH(Subtract)
        (own, shifted.data(), 1 / grid_.edge_m[0], count, velocity[0].row(y, z));
        HWY_DYNAMIC_DISPATCH(Subtract)
        (own, south, 1 / grid_.edge_m[1], count, velocity[1].row(y, z));
        if (z > 0) {
            HWY_DYNAMIC_DISPATCH(Subtract)
            (own, plane(z - 1) + y * count, 1 / grid_.edge_m[2], count, velocity[2].row(y, z));
        }
        for (Field& part : velocity) part.wrap(y, z);
    }
}

void Projection::project(std::array<Field, 3>& velocity, int threads) {
    const float scale = 1 / static_cast<float>(area_);
    each_level(grid_, threads, [&](int z) {
        Hartley::Scratch scratch;
        set_divergence(velocity, z);
        hartley_.transform(plane(z), scratch);
    });
    std::vector<float> mean(static_cast<std::size_t>(grid_.cells[2]));
    const auto levels = static_cast<std::size_t>(grid_.cells[2]);
    for (std::size_t z = 0; z < levels; ++z) mean[z] = *plane(static_cast<int>(z));
    parallel_for(grid_.cells[1], threads, [&](int y) { solve_columns(y); });
    for (std::size_t z = 0; z < levels; ++z) *plane(static_cast<int>(z)) = mean[z];
    solve_mean_column();
    each_level(grid_, threads, [&](int z) {
        Hartley::Scratch scratch;
        hartley_.transform(plane(z), scratch);
        for (std::size_t i = 0; i < area_; ++i) plane(z)[i] *= scale;
    });
    each_level(grid_, threads, [&](int z) { subtract_gradient(velocity, z); });
}

}  // namespace skybake::convection
#endif  // HWY_ONCE
