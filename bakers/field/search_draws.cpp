#include "bakers/field/search_draws.h"

#include <algorithm>
#include <cmath>

#include "bakers/math/parallel.h"
#include "bakers/math/quadrature.h"

namespace skybake {
namespace {

// The golden section, by which places in successive strata differ, and 1 / 1.3247... (the real root
// of g^3 = g + 1), by which the starts of successive rows do: they are in no rational relation.
constexpr double kGoldenShift = 0.6180339887498949;
constexpr double kRowShift = 0.7548776662466927;

double fraction_of(double x) { return x - std::floor(x); }

std::vector<double> shares_of(const SearchGrid& grid) {
    std::vector<double> shares;
    for (std::size_t i = 0; i < grid.count(); ++i) shares.push_back(grid.share(i));
    return shares;
}

// Returns, for each cell, the probability of a draw over the cell's share. A third is the same for
// all, a third is in proportion to the expected size, and a third to its square: the last would do
// where expectations are right, the others bound the weights where they are not.
std::vector<double> densities(const std::vector<double>& shares,
                              const std::vector<double>& squares) {
    double all = 0;
    double sizes = 0;
    double sum = 0;
    for (std::size_t i = 0; i < shares.size(); ++i) {
        all += shares[i];
        sizes += shares[i] * std::sqrt(squares[i]);
        sum += shares[i] * squares[i];
    }
    std::vector<double> result(shares.size(), 1 / all);
    if (!(sum > 0) || !std::isfinite(sum)) return result;
    for (std::size_t i = 0; i < shares.size(); ++i) {
        result[i] = (result[i] + std::sqrt(squares[i]) / sizes + squares[i] / sum) / 3;
    }
    return result;
}

// The place of a draw. Along the first axis the cumulative probability goes on within the cell, so
// that draws which share a cell are spread over it.
SearchPlace place_of(const SearchGrid& grid, const Draw& drawn, std::size_t index) {
    SearchPlace within = low_discrepancy_point(static_cast<int>(index));
    within[0] = drawn.within;
    return grid.place(drawn.index, within);
}

}  // namespace

// The cumulative probability is cut into `count` equal strata, and a place is drawn in each.
std::vector<Draw> draw(const std::vector<double>& shares, const std::vector<double>& squares,
                       int count, double start) {
    const std::vector<double> density = densities(shares, squares);
    std::vector<Draw> draws;
    double before = 0;
    for (std::size_t i = 0; i < shares.size(); ++i) {
        const double probability = shares[i] * density[i];
        while (draws.size() < static_cast<std::size_t>(count)) {
            const auto stratum = static_cast<double>(draws.size());
            const double at = (stratum + fraction_of(start + stratum * kGoldenShift)) / count;
            if (at >= before + probability) break;
            draws.push_back({i, 1 / (density[i] * count), (at - before) / probability});
        }
        before += probability;
    }
    return draws;
}

std::vector<std::size_t> largest_of(const std::vector<double>& values, std::size_t count) {
    std::vector<std::size_t> order(values.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    const auto end = order.begin() + static_cast<std::ptrdiff_t>(std::min(count, order.size()));
    std::partial_sort(order.begin(), end, order.end(), [&](std::size_t a, std::size_t b) {
        return values[a] != values[b] ? values[a] > values[b] : a < b;
    });
    order.erase(end, order.end());
    return order;
}

SearchDraws::SearchDraws(const LookupSearch& search, int threads)
    : search_(search),
      row_shares_(shares_of(search.rows)),
      point_shares_(shares_of(search.points)),
      row_squares_(row_shares_.size(), 1),
      row_peaks_(row_shares_.size(), 0) {
    if (!search.expected) return;
    parallel_for(static_cast<int>(row_shares_.size()), threads, [&](int row) {
        const auto i = static_cast<std::size_t>(row);
        row_squares_[i] = 0;
        for (std::size_t k = 0; k < point_shares_.size(); ++k) {
            const double expected = search.expected(i, k);
            row_squares_[i] += point_shares_[k] * expected * expected;
            row_peaks_[i] = std::max(row_peaks_[i], expected);
        }
    });
}

std::vector<SearchRow> SearchDraws::rows(int count, int per_row, double weight) const {
    std::vector<SearchRow> rows;
    const std::vector<Draw> draws = draw(row_shares_, row_squares_, count, 0.5);
    for (std::size_t i = 0; i < draws.size(); ++i) {
        SearchRow row;
        row.at = place_of(search_.rows, draws[i], i);
        const double start = fraction_of(static_cast<double>(i) * kRowShift);
        for (const Draw& point : draw(point_shares_, squares_in(draws[i].index), per_row, start)) {
            const std::size_t index = i * static_cast<std::size_t>(per_row) + row.points.size();
            row.points.push_back(place_of(search_.points, point, index));
            row.weights.push_back(weight * draws[i].weight * point.weight);
        }
        rows.push_back(std::move(row));
    }
    return rows;
}

std::vector<SearchRow> SearchDraws::peak_rows(int count, int per_row) const {
    std::vector<SearchRow> rows;
    if (!search_.expected) return rows;
    for (const std::size_t index : largest_of(row_peaks_, static_cast<std::size_t>(count))) {
        std::vector<double> expected;
        for (std::size_t k = 0; k < point_shares_.size(); ++k) {
            expected.push_back(search_.expected(index, k));
        }
        SearchRow row;
        row.at = search_.rows.middle(index);
        for (const std::size_t point : largest_of(expected, static_cast<std::size_t>(per_row))) {
            row.points.push_back(search_.points.middle(point));
        }
        row.weights.assign(row.points.size(), 0);
        rows.push_back(std::move(row));
    }
    return rows;
}

void SearchDraws::learn(const std::vector<SearchPoint>& measured, double mean_square) {
    double expected = 0;
    for (std::size_t i = 0; i < row_shares_.size(); ++i) {
        expected += row_shares_[i] * row_squares_[i];
    }
    scale_ = expected > 0 ? mean_square / expected : 1;
    if (!(scale_ > 0) || !std::isfinite(scale_)) scale_ = 1;
    for (double& square : row_squares_) square *= scale_;
    for (const SearchPoint& point : measured) {
        const std::size_t row = search_.rows.cell_at(point.row);
        const std::size_t column = search_.points.cell_at(point.point);
        if (!std::isfinite(point.error.mean_square)) continue;
        const double known = square_of(row, column);
        if (point.error.mean_square <= known) continue;
        row_squares_[row] += point_shares_[column] * (point.error.mean_square - known);
        found_[{row, column}] = point.error.mean_square;
    }
}

double SearchDraws::square_of(std::size_t row, std::size_t column) const {
    const auto found = found_.find({row, column});
    if (found != found_.end()) return found->second;
    const double expected = search_.expected ? search_.expected(row, column) : 1;
    return scale_ * expected * expected;
}

std::vector<double> SearchDraws::squares_in(std::size_t row) const {
    std::vector<double> squares;
    for (std::size_t k = 0; k < point_shares_.size(); ++k) squares.push_back(square_of(row, k));
    return squares;
}

}  // namespace skybake
