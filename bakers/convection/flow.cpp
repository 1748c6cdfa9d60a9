#include "bakers/convection/flow.h"

#include <cmath>

#include "bakers/convection/saturation.h"
#include "bakers/convection/transport.h"

namespace skybake::convection {

namespace {

constexpr double kMostCourant =
    1.2;  // cells per step, summed over the axes; 1.4 is the limit of the scheme
constexpr double kLongestStep = 8;  // s
constexpr int kSlab = 8;            // levels that a thread takes at once

}  // namespace

Flow::Flow(const Specification& wanted, int threads)
    : wanted_(wanted),
      threads_(threads),
      sounding_(make_sounding(wanted)),
      source_(wanted, sounding_),
      projection_(wanted.grid),
      before_(wanted.grid),
      now_(wanted.grid),
      next_(wanted.grid),
      buoyancy_(wanted.grid) {
    for (const Level& level : sounding_.levels) own_heat_.push_back(virtual_heat(level));
    each_level(wanted.grid, threads, [&](int z) {
        const Level& level = sounding_.levels[static_cast<std::size_t>(z)];
        const auto row = static_cast<std::size_t>(wanted_.grid.stride());
        for (int y = 0; y < wanted_.grid.cells[1]; ++y) {
            std::fill_n(now_.heat.row(y, z) - kMargin, row, level.heat);
            std::fill_n(now_.water.row(y, z) - kMargin, row, level.water);
            for (std::size_t k = 0; k < 2; ++k) {
                std::fill_n(now_.velocity[k].row(y, z) - kMargin, row, level.wind_m_per_s[k]);
            }
        }
    });
}

void Flow::condensed_row(int y, int z, float* out) const {
    condensed({now_.heat.row(y, z), now_.water.row(y, z), wanted_.grid.cells[0]},
              sounding_.levels[static_cast<std::size_t>(z)], out);
}

double Flow::longest_step() const {
    std::vector<float> most(static_cast<std::size_t>(wanted_.grid.cells[2]), 0.0F);
    const std::array<float, 3>& edge = wanted_.grid.edge_m;
    each_level(wanted_.grid, threads_, [&](int z) {
        float largest = 0;
        for (int y = 0; y < wanted_.grid.cells[1]; ++y) {
            const float* u = now_.velocity[0].row(y, z);
            const float* v = now_.velocity[1].row(y, z);
            const float* w = now_.velocity[2].row(y, z);
            for (int x = 0; x < wanted_.grid.cells[0]; ++x) {
                const float cells = (std::fabs(u[x]) / edge[0] + std::fabs(v[x]) / edge[1]) +
                                    std::fabs(w[x]) / edge[2];
                largest = cells > largest ? cells : largest;
            }
        }
        most[static_cast<std::size_t>(z)] = largest;
    });
    float largest = 0;
    for (const float cells : most) largest = std::max(largest, cells);
    return std::min(kLongestStep, kMostCourant / std::max(1e-6, double{largest}));
}

// Adds buoyancy and the sponge to the vertical wind of a level of `next_`.
void Flow::lift_level(int z, float step_s) {
    constexpr float kCalmed = 30;  // s, in which the sponge takes the wind at the lid
    const int into = z - (wanted_.grid.cells[2] - wanted_.sponge_levels);
    const float depth =
        std::max(0.0F, static_cast<float>(into) / static_cast<float>(wanted_.sponge_levels));
    const float kept = 1 / (1 + step_s / kCalmed * depth);
    for (int y = 0; y < wanted_.grid.cells[1]; ++y) {
        float* __restrict wind = next_.velocity[2].row(y, z);
        const float* __restrict own = buoyancy_.row(y, z);
        const float* __restrict below = buoyancy_.row(y, z - 1);
        for (int x = 0; x < wanted_.grid.cells[0]; ++x) {
            wind[x] = z == 0 ? 0.0F : (wind[x] + step_s * 0.5F * (own[x] + below[x])) * kept;
        }
    }
}

void Flow::push(float step_s) {
    const Grid& grid = wanted_.grid;
    each_level(grid, threads_, [&](int z) {
        for (int y = 0; y < grid.cells[1]; ++y) {
            buoyancies({now_.heat.row(y, z), now_.water.row(y, z), grid.cells[0]},
                       sounding_.levels[static_cast<std::size_t>(z)],
                       own_heat_[static_cast<std::size_t>(z)], buoyancy_.row(y, z));
        }
    });
    const int slabs = (grid.cells[2] + kSlab - 1) / kSlab;
    parallel_for(5 * slabs, threads_, [&](int task) {
        const int first = task % slabs * kSlab;
        const int last = std::min(first + kSlab, grid.cells[2]);
        const int field = task / slabs;
        const auto field_of = [field](auto& state) -> auto& {
            if (field == 3) return state.heat;
            return field == 4 ? state.water : state.velocity[static_cast<std::size_t>(field)];
        };
        transport(grid,
                  {now_.velocity, field_of(now_), field_of(before_), std::min(field, 3),
                   field >= 3 ? Flux::weighted : Flux::upwind, step_s},
                  first, last, field_of(next_));
        if (field != 2) return;
        for (int z = first; z < last; ++z) lift_level(z, step_s);
    });
    std::swap(now_, next_);
    projection_.project(now_.velocity, threads_);
}

void Flow::step(double end_s) {
    const double step_s = std::min(longest_step(), end_s - time_s_);
    parallel_for(source_.levels(), threads_,
                 [&](int z) { source_.warm(time_s_, step_s, z, now_); });
    before_ = now_;
    for (const float share : {1.0F / 3, 0.5F, 1.0F}) push(share * static_cast<float>(step_s));
    time_s_ += step_s;
}

}  // namespace skybake::convection
