#include "bakers/convection/flow.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bakers/convection/saturation.h"
#include "bakers/convection/transport.h"
#include "bakers/math/mix64.h"
#include "bakers/math/transcendental.h"

namespace skybake::convection {
namespace {

constexpr double kDrawn_s = 60;   // in which air above a patch takes on its warmth
constexpr double kMoment_s = 20;  // for which the noise of the warming stays
constexpr double kReach = 3;      // radii of a patch

std::uint64_t mixed(std::uint64_t x) { return mix64(x + kGolden64); }

// In [0, 1).
double number(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-53; }

// The distance around a circle.
double around(double distance, double length) {
    return distance - length * std::floor(distance / length + 0.5);
}

// Numbers in [0, 1), one after another.
struct Numbers {
    std::uint64_t bits = 0;
    double next() { return number(bits = mixed(bits)); }
};

// A thermal that rises from a patch: warm air gathers here and there on it, and for a while.
Patch make_pulse(const Specification& wanted, const Patch& patch, Numbers& numbers) {
    Patch pulse = patch;
    const double away = std::sqrt(numbers.next());
    const SineCosine turn = sine_and_cosine(2 * std::numbers::pi * numbers.next());
    pulse.centre_m[0] += patch.radius_m * away * turn.cosine;
    pulse.centre_m[1] += patch.radius_m * away * turn.sine;
    pulse.radius_m *= 0.3 + 0.4 * numbers.next();
    pulse.strength = (1 - 0.4 * away) * (0.7 + 0.6 * numbers.next());
    pulse.begin_s = 0.6 * wanted.growth_s * numbers.next();
    pulse.end_s = pulse.begin_s + wanted.growth_s * (0.3 + 0.4 * numbers.next());
    return pulse;
}

}  // namespace

float noise_at(std::uint64_t seed, const std::array<int, 3>& cell, int moment) {
    std::uint64_t bits = mixed(seed);
    for (const int i : {cell[0], cell[1], cell[2], moment})
        bits = mixed(bits ^ static_cast<std::uint64_t>(i));
    return static_cast<float>(2 * number(bits) - 1);
}

std::vector<Patch> make_patches(const Specification& wanted) {
    constexpr int kPulses = 8;  // of a patch
    std::vector<Patch> pulses;
    const Grid& grid = wanted.grid;
    for (int i = 0; i < wanted.patches; ++i) {
        Numbers numbers{mixed(wanted.seed ^ mixed(static_cast<std::uint64_t>(i)))};
        Patch patch;
        for (std::size_t k = 0; k < 2; ++k) {
            patch.centre_m[k] = numbers.next() * grid.cells[k] * double{grid.edge_m[k]};
        }
        const double share = numbers.next();
        const auto& [narrow, wide] = wanted.patch_width_m;
        patch.radius_m = 0.5 * (narrow + (wide - narrow) * share * share);  // most are small
        for (int k = 0; k < kPulses; ++k) pulses.push_back(make_pulse(wanted, patch, numbers));
    }
    return pulses;
}

PatchSource::PatchSource(const Specification& wanted, const Sounding& sounding)
    : wanted_(wanted),
      patches_(make_patches(wanted)),
      heat_(sounding.patch_heat),
      water_(sounding.patch_water),
      levels_(std::max(2, wanted.mixed_levels / 3)) {}

float PatchSource::share_at(const std::vector<Patch>& patches, int x, int y) const {
    const Grid& grid = wanted_.grid;
    double share = 0;
    for (const Patch& patch : patches) {
        double squares = 0;
        for (std::size_t k = 0; k < 2; ++k) {
            const double at = ((k == 0 ? x : y) + 0.5) * double{grid.edge_m[k]};
            const double away =
                around(at - patch.centre_m[k], grid.cells[k] * double{grid.edge_m[k]});
            squares += away * away;
        }
        squares /= patch.radius_m * patch.radius_m;
        if (squares < kReach * kReach) share += patch.strength * exponential(-squares);
    }
    return static_cast<float>(share);
}

void PatchSource::warm(double time_s, double step_s, int z, State& state) const {
    std::vector<Patch> active;
    for (const Patch& patch : patches_) {
        const double since_s = time_s - patch.begin_s;
        const double into_s = since_s - wanted_.growth_s * std::floor(since_s / wanted_.growth_s);
        if (since_s >= 0 && into_s < patch.end_s - patch.begin_s) active.push_back(patch);
    }
    if (active.empty()) return;
    const auto rate = static_cast<float>(step_s / kDrawn_s);
    const int moment = static_cast<int>(time_s / kMoment_s);
    for (int y = 0; y < wanted_.grid.cells[1]; ++y) {
        float* heat = state.heat.row(y, z);
        float* water = state.water.row(y, z);
        for (int x = 0; x < wanted_.grid.cells[0]; ++x) {
            const float share = share_at(active, x, y);
            if (share == 0) continue;
            const float noise = 1 + 0.3F * noise_at(wanted_.seed, {x, y, z}, moment);
            const float drawn = std::min(1.0F, rate * share * noise);
            heat[x] += drawn * std::max(0.0F, heat_ - heat[x]);
            water[x] += drawn * std::max(0.0F, water_ - water[x]);
        }
        state.heat.wrap(y, z);
        state.water.wrap(y, z);
    }
}

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

void Flow::velocity_row(std::size_t axis, int y, int z, float* out) const {
    const Field& velocity = now_.velocity[axis];
    const float* lower = velocity.row(y, z);
    const float* upper = velocity.row(axis == 1 ? y + 1 : y, axis == 2 ? z + 1 : z);
    const int cells = wanted_.grid.cells[0];
    for (int x = 0; x < cells; ++x) {
        out[x] = (lower[x] + upper[axis == 0 ? (x + 1) % cells : x]) / 2;
    }
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
