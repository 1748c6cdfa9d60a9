#include "bakers/assets/cloud_light/radiance_levels.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>
#include <utility>

#include "bakers/math/harmonics.h"
#include "bakers/math/parallel.h"
#include "bakers/math/transcendental.h"
#include "bakers/occupancy/cell_grid.h"

namespace skybake::cloud_light {
namespace {

// A sweep over fewer cells costs no more than its overhead.
constexpr std::size_t kFewCells = 64;
// Errors of finer cells need not be known better than this. Of the finest cells two sweeps in each pay best.
constexpr SolutionEnd kEndOfError = {0.02, 2};
constexpr int kSweepsOfFewCells = 24;
// A sweep is slow if it leaves more than this share of the change before it, the second one of all light. Sweeps of the
// presets leave at most 0.6 and 0.12.
constexpr double kSlow = 0.75;
constexpr double kSlowSecond = 0.25;
constexpr std::size_t kPastSteps = 8;
// Planes of fewer cells are done before threads have begun.
constexpr std::size_t kCellsOfThreads = 1 << 15;
// A rest is known to 1e-7 of the light. Where less than this leaves a cell, the sum of its orders would be rounding.
constexpr float kLeastLeaving = 1e-3F;

BakeOptions with_threads_for(const CellFields& fields, const BakeOptions& options) {
    BakeOptions own = options;
    if (occupancy::count_of(fields.size()) < kCellsOfThreads) own.threads = 1;
    return own;
}

// The sum of a b, number by number. It does not depend on the number of threads.
double product(const CellFields& a, const CellFields& b, const BakeOptions& options) {
    constexpr std::size_t kChains = 8;  // of additions, which do not wait for each other
    std::vector<double> sums(static_cast<std::size_t>(a.size()[2]));
    for_each_plane(a, options, [&](int z) {
        std::array<double, kChains> chains{};
        for_each_row(a, [&](std::size_t c, int y) {
            const float* of_a = a.row(c, z, y);
            const float* of_b = b.row(c, z, y);
            const auto count = static_cast<std::size_t>(a.size()[0]);
            for (std::size_t x = 0; x < count; ++x) {
                chains[x % kChains] += double{of_a[x]} * double{of_b[x]};
            }
        });
        sums[static_cast<std::size_t>(z)] = std::accumulate(chains.begin(), chains.end(), 0.0);
    });
    return std::accumulate(sums.begin(), sums.end(), 0.0);
}

// to = use(a, b), number by number.
template <class Use>
void combine(const CellFields& a, const CellFields& b, CellFields& to, const BakeOptions& options,
             const Use& use) {
    for_each_plane(to, options, [&](int z) {
        for_each_row(to, [&](std::size_t c, int y) {
            const float* of_a = a.row(c, z, y);
            const float* of_b = b.row(c, z, y);
            float* row = to.row(c, z, y);
            for (int x = 0; x < to.size()[0]; ++x) row[x] = use(of_a[x], of_b[x]);
        });
    });
}

// to += share * from
void add(const CellFields& from, double share, CellFields& to, const BakeOptions& options) {
    const auto weight = static_cast<float>(share);
    combine(to, from, to, options, [weight](float a, float b) { return a + weight * b; });
}

// Makes the coefficients of mean radiance those of what cells scatter of it.
void scatter(const std::vector<double>& returned, CellFields& radiance,
             const BakeOptions& options) {
    for_each_plane(radiance, options, [&](int z) {
        for_each_row(radiance, [&](std::size_t c, int y) {
            const auto factor = static_cast<float>(returned[degree_of_harmonic(c)]);
            float* row = radiance.row(c, z, y);
            for (int x = 0; x < radiance.size()[0]; ++x) row[x] *= factor;
        });
    });
}

// Adds to a rest what follows from it within each cell: what a cell sends out and does not leave it, it sends out
// again. Thick cells would need many sweeps for that.
void add_own_orders(const CellFields& leaving, const std::vector<double>& returned,
                    CellFields& rest, const BakeOptions& options) {
    for_each_plane(rest, options, [&](int z) {
        for_each_row(rest, [&](std::size_t c, int y) {
            const auto again = static_cast<float>(returned[degree_of_harmonic(c)]);
            const float* leaves = leaving.row(0, z, y);
            float* row = rest.row(c, z, y);
            for (int x = 0; x < rest.size()[0]; ++x) {
                row[x] /= 1 - again + again * std::max(leaves[x], kLeastLeaving);
            }
        });
    });
}

// Learns from past corrections what each takes from those that follow it, and takes that away beforehand (Anderson
// 1965, "Iterative Procedures for Nonlinear Integral Equations"). Coarser cells do not have the gaps between thick
// cells, through which light leaves: what they answer can be far too much, and would grow from sweep to sweep.
class PastCorrections {
  public:
    // Improves `light` and the correction that is about to be added to it.
    void improve(CellFields& light, CellFields& correction, const BakeOptions& options) {
        Step now{light, correction};
        if (last_) {
            Step step = now;
            add(last_->light, -1, step.light, options);
            add(last_->correction, -1, step.correction, options);
            for (const Step& one : steps_) take(one, step.correction, step.light, options);
            step.size = product(step.correction, step.correction, options);
            if (step.size > 0) steps_.push_back(std::move(step));
            if (steps_.size() > kPastSteps) steps_.erase(steps_.begin());
            for (const Step& one : steps_) take(one, correction, light, options);
        }
        last_ = std::move(now);
    }

  private:
    // Light and the correction of it, or how both changed.
    struct Step {
        CellFields light;
        CellFields correction;
        double size = 0;
    };

    static void take(const Step& step, CellFields& correction, CellFields& light,
                     const BakeOptions& options) {
        const double share = product(correction, step.correction, options) / step.size;
        add(step.correction, -share, correction, options);
        add(step.light, -share, light, options);
    }

    std::vector<Step> steps_;
    std::optional<Step> last_;
};

// Sweeps divide the change by about the same factor each.
void show_progress(double change, double last_change, const BakeOptions& options) {
    if (options.progress == nullptr || !(change > 0)) return;
    const double done = logarithm(change) / logarithm(last_change);
    options.progress->advance("sweeps", std::clamp(done, 0.0, 1.0));
}

}  // namespace

RadianceLevels::RadianceLevels(const LayerCells& cells, const std::vector<double>& returned,
                               const BakeOptions& options)
    : extinction_(cells.extinction),
      returned_(returned),
      sweep_(cells, static_cast<int>(returned.size()) - 1,
             with_threads_for(extinction_, options).threads),
      factors_(coarser_factors(extinction_.size())) {
    if (occupancy::count_of(extinction_.size()) <= kFewCells || factors_ == kSameCells) return;
    coarser_ =
        std::make_unique<const RadianceLevels>(coarser_cells(cells, factors_), returned, options);
}

void RadianceLevels::add_later_orders(CellFields& rest, const BakeOptions& options) const {
    if (!coarser_) {
        add_own_orders(sweep_.leaving(), returned_, rest, options);
        return;
    }
    CellFields smooth = mean_light(rest, extinction_, factors_, options);
    CellFields more = coarser_->solve(smooth, {}, kEndOfError, options).light;
    combine(more, smooth, more, options, std::plus<>());
    add_interpolated(smooth, factors_, -1, rest, options);
    add_own_orders(sweep_.leaving(), returned_, rest, options);
    add_interpolated(more, factors_, 1, rest, options);
}

ScatteredLight RadianceLevels::solve(const CellFields& first, const EnteringLight& entering,
                                     const SolutionEnd& end, const BakeOptions& options) const {
    const BakeOptions own = with_threads_for(first, options);
    const int most_sweeps = coarser_ ? end.sweeps : std::max(end.sweeps, kSweepsOfFewCells);
    ScatteredLight result{CellFields(first.size(), first.count()), 0, 1};
    CellFields sent_out = result.light;
    CellFields rest = result.light;
    PastCorrections past;
    bool is_slow = false;
    while (result.change > end.change && result.sweeps < most_sweeps && !options.cancelled()) {
        combine(result.light, first, sent_out, own, std::plus<>());
        sweep_.find_radiance(sent_out, entering, rest, own);
        scatter(returned_, rest, own);
        ++result.sweeps;
        const double size = product(rest, rest, own);
        combine(rest, result.light, rest, own, std::minus<>());
        const double changed = product(rest, rest, own);
        const double slow = result.sweeps == 2 ? kSlowSecond : kSlow * result.change;
        result.change = changed == 0 ? 0 : std::sqrt(changed / size);
        is_slow = is_slow || (result.sweeps > 1 && result.change > slow);
        if (end.is_shown) show_progress(result.change, end.change, own);
        add_later_orders(rest, own);
        if (is_slow) past.improve(result.light, rest, own);
        combine(result.light, rest, result.light, own, std::plus<>());
    }
    return result;
}

}  // namespace skybake::cloud_light
