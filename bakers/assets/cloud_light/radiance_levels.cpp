#include "bakers/assets/cloud_light/radiance_levels.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bakers/assets/cloud_light/anderson_guesses.h"
#include "bakers/math/harmonics.h"
#include "bakers/occupancy/cell_grid.h"

namespace skybake::cloud_light {
namespace {

// A sweep over fewer cells costs no more than its overhead.
constexpr std::size_t kFewCells = 512;
// Errors of finer cells need not be known better than this. Of the finest cells two sweeps in each pay best.
constexpr SolutionEnd kEndOfError = {0.02, 2};
constexpr int kSweepsOfFewCells = 24;
// Planes of fewer cells are done before threads have begun.
constexpr std::size_t kCellsOfThreads = 1 << 15;
// A rest is known to 1e-7 of the light. Where less than this leaves a cell, the sum of its orders would be rounding.
constexpr float kLeastLeaving = 1e-3F;

BakeOptions with_threads_for(const CellFields& fields, const BakeOptions& options) {
    BakeOptions own = options;
    if (occupancy::count_of(fields.size()) < kCellsOfThreads) own.threads = 1;
    return own;
}

float sum_of(float a, float b) { return a + b; }
float difference_of(float a, float b) { return a - b; }

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

}  // namespace

RadianceLevels::RadianceLevels(const LayerCells& cells, const std::vector<double>& returned,
                               const BakeOptions& options)
    : extinction_(cells.extinction),
      returned_(returned),
      sweep_(cells, static_cast<int>(returned.size()) - 1, with_threads_for(extinction_, options)),
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
    combine(more, smooth, more, options, sum_of);
    add_interpolated(smooth, factors_, -1, rest, options);
    add_own_orders(sweep_.leaving(), returned_, rest, options);
    add_interpolated(more, factors_, 1, rest, options);
}

ScatteredLight RadianceLevels::solve(const CellFields& first, const EnteringLight& entering,
                                     const SolutionEnd& end, const BakeOptions& options) const {
    const BakeOptions own = with_threads_for(first, options);
    const int most_sweeps = coarser_ ? end.sweeps : std::max(end.sweeps, kSweepsOfFewCells);
    const CellFields nothing(first.size(), first.count());
    AndersonGuesses guesses(own);
    Guess guess{nothing, nothing};
    CellFields sent_out = nothing;
    ScatteredLight result{{}, 0, 1};
    while (result.change > end.change && result.sweeps < most_sweeps && !own.cancelled()) {
        if (result.sweeps > 0) guess = guesses.next(std::move(guess));
        combine(guess.light, first, sent_out, options, sum_of);
        sweep_.find_radiance(sent_out, entering, guess.change);
        scatter(returned_, guess.change, own);
        ++result.sweeps;
        const double size = inner_product(guess.change, guess.change, own);
        combine(guess.change, guess.light, guess.change, options, difference_of);
        const double changed = inner_product(guess.change, guess.change, own);
        result.change = changed > 0 ? std::sqrt(changed / size) : 0;
        add_later_orders(guess.change, own);
    }
    result.light = std::move(guess.light);
    combine(result.light, guess.change, result.light, own, sum_of);
    return result;
}

}  // namespace skybake::cloud_light
