#include "bakers/field/error_search.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "bakers/math/parallel.h"
#include "bakers/math/quadrature.h"

namespace skybake {

SearchGrid::SearchGrid(std::vector<std::vector<double>> edges) : edges_(std::move(edges)) {
    assert(edges_.size() <= 3);
    for (const std::vector<double>& axis : edges_) {
        assert(axis.size() >= 2);
        count_ *= axis.size() - 1;
    }
}

std::array<std::size_t, 3> SearchGrid::indices(std::size_t cell) const {
    std::array<std::size_t, 3> result{};
    for (std::size_t a = 0; a < edges_.size(); ++a) {
        const std::size_t cells = edges_[a].size() - 1;
        result[a] = cell % cells;
        cell /= cells;
    }
    return result;
}

double SearchGrid::share(std::size_t cell) const {
    const std::array<std::size_t, 3> index = indices(cell);
    double share = 1;
    for (std::size_t a = 0; a < edges_.size(); ++a) {
        share *= (edges_[a][index[a] + 1] - edges_[a][index[a]]) /
                 (edges_[a].back() - edges_[a].front());
    }
    return share;
}

SearchPlace SearchGrid::place(std::size_t cell, const SearchPlace& within) const {
    const std::array<std::size_t, 3> index = indices(cell);
    SearchPlace result{};
    for (std::size_t a = 0; a < edges_.size(); ++a) {
        const double low = edges_[a][index[a]];
        const double high = edges_[a][index[a] + 1];
        result[a] = std::clamp(low + within[a] * (high - low), low, high);
    }
    return result;
}

std::size_t SearchGrid::cell_at(const SearchPlace& place) const {
    std::size_t cell = 0;
    std::size_t stride = 1;
    for (std::size_t a = 0; a < edges_.size(); ++a) {
        const std::vector<double>& axis = edges_[a];
        const auto above = std::upper_bound(axis.begin() + 1, axis.end() - 1, place[a]);
        cell += stride * static_cast<std::size_t>(above - axis.begin() - 1);
        stride *= axis.size() - 1;
    }
    return cell;
}

SearchPlace SearchGrid::moved(const SearchPlace& place, std::size_t axis, double widths) const {
    const std::size_t index = indices(cell_at(place))[axis];
    const std::vector<double>& edges = edges_[axis];
    SearchPlace result = place;
    result[axis] = std::clamp(place[axis] + widths * (edges[index + 1] - edges[index]),
                              edges.front(), edges.back());
    return result;
}

PointError PointError::of(const double* errors, std::size_t channels) {
    PointError result;
    for (std::size_t c = 0; c < channels; ++c) {
        const double size =
            std::isnan(errors[c]) ? std::numeric_limits<double>::infinity() : std::fabs(errors[c]);
        result.largest = std::max(result.largest, size);
        result.mean_square += size * size / static_cast<double>(channels);
    }
    return result;
}

namespace {

// The share of the first rows, which are a quarter, in the mean square. Later rows are drawn with
// what the first have shown, so they count for more.
constexpr double kFirstShare = 0.15;

// The golden section, by which starts of successive series of draws differ.
constexpr double kGoldenShift = 0.6180339887498949;

double fraction_of(double x) { return x - std::floor(x); }

// One of several cells or points, and the weight of its square in the mean of all.
struct Draw {
    std::size_t index = 0;
    double weight = 0;
};

// Draws with a probability of which a third is in proportion to the share, a third to the share
// times the expected size, and a third to the share times its square: the last would do where
// expectations are right, the others bound the weights where they are not. Draws lie at equal steps
// of the cumulative probability, `start` in [0, 1) of a step from 0, so that neighbours are not
// drawn together by chance.
std::vector<Draw> draw(const std::vector<double>& shares, const std::vector<double>& squares,
                       int count, double start) {
    double all = 0;
    double sizes = 0;
    double sum = 0;
    for (std::size_t i = 0; i < shares.size(); ++i) {
        all += shares[i];
        sizes += shares[i] * std::sqrt(squares[i]);
        sum += shares[i] * squares[i];
    }
    const bool known = sum > 0 && std::isfinite(sum);
    std::vector<Draw> draws;
    double cumulative = 0;
    for (std::size_t i = 0; i < shares.size(); ++i) {
        double density = 1 / all;
        if (known) {
            density = (density + std::sqrt(squares[i]) / sizes + squares[i] / sum) / 3;
        }
        cumulative += shares[i] * density;
        while (static_cast<double>(draws.size()) + start < cumulative * count) {
            draws.push_back({i, 1 / (density * count)});
        }
    }
    return draws;
}

// A row that is evaluated together, and the weights of its points in the mean square; points of
// weight 0 are there for the maximum alone.
struct SearchRow {
    SearchPlace at{};
    std::vector<SearchPlace> points;
    std::vector<double> weights;
    std::vector<PointError> errors;
};

struct SearchPoint {
    SearchPlace row{};
    SearchPlace point{};
    double weight = 0;
    PointError error;
};

// The `count` largest elements' indices, the largest first; of equal ones, the first.
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

class ErrorSearch {
  public:
    ErrorSearch(const LookupSearch& search, const SearchCounts& counts, const BakeOptions& options)
        : search_(search), counts_(counts), options_(options) {
        for (std::size_t i = 0; i < search.rows.count(); ++i) {
            row_shares_.push_back(search.rows.share(i));
        }
        for (std::size_t i = 0; i < search.points.count(); ++i) {
            point_shares_.push_back(search.points.share(i));
        }
    }

    FoundErrors run() {
        look_at_texels();
        const int first = std::max(1, counts_.rows / 4);
        first_share_ = first < counts_.rows ? kFirstShare : 1;
        std::vector<SearchRow> rows = drawn_rows(first, first_share_);
        add_peak_rows(rows);
        evaluate(std::move(rows), searched());
        climb();
        if (options_.cancelled()) return {};
        learn();
        evaluate(drawn_rows(counts_.rows - first, 1 - first_share_), searched());
        return search_.estimate ? confirm() : figures_of(measured_, mean_square());
    }

  private:
    const RowErrors& searched() const {
        return search_.estimate ? search_.estimate : search_.exact;
    }

    // What the texels let expect of each row.
    void look_at_texels() {
        row_squares_.assign(row_shares_.size(), 1);
        row_peaks_.assign(row_shares_.size(), 0);
        if (!search_.expected) return;
        parallel_for(static_cast<int>(row_shares_.size()), options_.threads, [&](int row) {
            const auto i = static_cast<std::size_t>(row);
            row_squares_[i] = 0;
            for (std::size_t k = 0; k < point_shares_.size(); ++k) {
                const double expected = search_.expected(i, k);
                row_squares_[i] += point_shares_[k] * expected * expected;
                row_peaks_[i] = std::max(row_peaks_[i], expected);
            }
        });
    }

    // What the first points let expect of the others: the texels' expectations, in the scale of
    // the errors found, and in the cells where a larger error was found that error.
    void learn() {
        double expected = 0;
        for (std::size_t i = 0; i < row_shares_.size(); ++i) {
            expected += row_shares_[i] * row_squares_[i];
        }
        scale_ = expected > 0 ? mean_square() / first_share_ / expected : 1;
        if (!(scale_ > 0) || !std::isfinite(scale_)) scale_ = 1;
        for (double& square : row_squares_) square *= scale_;
        for (const SearchPoint& point : measured_) {
            const std::size_t row = search_.rows.cell_at(point.row);
            const std::size_t column = search_.points.cell_at(point.point);
            if (!std::isfinite(point.error.mean_square)) continue;
            const double known = square_of(row, column);
            if (point.error.mean_square <= known) continue;
            row_squares_[row] += point_shares_[column] * (point.error.mean_square - known);
            found_[{row, column}] = point.error.mean_square;
        }
    }

    double square_of(std::size_t row, std::size_t column) const {
        const auto found = found_.find({row, column});
        if (found != found_.end()) return found->second;
        const double expected = search_.expected ? search_.expected(row, column) : 1;
        return scale_ * expected * expected;
    }

    std::vector<double> expected_in(std::size_t row) const {
        std::vector<double> values(point_shares_.size(), 1);
        for (std::size_t k = 0; search_.expected && k < values.size(); ++k) {
            values[k] = search_.expected(row, k);
        }
        return values;
    }

    std::vector<SearchRow> drawn_rows(int count, double weight) const {
        std::vector<SearchRow> rows;
        const std::vector<Draw> draws = draw(row_shares_, row_squares_, count, 0.5);
        for (std::size_t i = 0; i < draws.size(); ++i) {
            SearchRow row;
            row.at = search_.rows.place(draws[i].index, low_discrepancy_point(static_cast<int>(i)));
            std::vector<double> squares(point_shares_.size());
            for (std::size_t k = 0; k < squares.size(); ++k) {
                squares[k] = square_of(draws[i].index, k);
            }
            const double start = fraction_of(static_cast<double>(i) * kGoldenShift);
            for (const Draw& point : draw(point_shares_, squares, counts_.per_row, start)) {
                const auto index = static_cast<int>(i * static_cast<std::size_t>(counts_.per_row) +
                                                    row.points.size());
                row.points.push_back(
                    search_.points.place(point.index, low_discrepancy_point(index)));
                row.weights.push_back(weight * draws[i].weight * point.weight);
            }
            rows.push_back(std::move(row));
        }
        return rows;
    }

    // Middles of the cells in which the largest errors are expected.
    void add_peak_rows(std::vector<SearchRow>& rows) const {
        if (!search_.expected) return;
        for (const std::size_t index :
             largest_of(row_peaks_, static_cast<std::size_t>(counts_.peak_rows))) {
            SearchRow row;
            row.at = search_.rows.middle(index);
            for (const std::size_t point :
                 largest_of(expected_in(index), static_cast<std::size_t>(counts_.per_row))) {
                row.points.push_back(search_.points.middle(point));
            }
            row.weights.assign(row.points.size(), 0);
            rows.push_back(std::move(row));
        }
    }

    // Returns the number of the first new point in measured_.
    std::size_t evaluate(std::vector<SearchRow> rows, const RowErrors& errors) {
        const std::size_t first = measured_.size();
        for_each_tile(static_cast<int>(rows.size()), options_, "certify", [&](int i) {
            SearchRow& row = rows[static_cast<std::size_t>(i)];
            row.errors.resize(row.points.size());
            errors(row.at, row.points, row.errors.data());
        });
        for (const SearchRow& row : rows) {
            for (std::size_t k = 0; k < row.errors.size(); ++k) {
                measured_.push_back({row.at, row.points[k], row.weights[k], row.errors[k]});
            }
        }
        return first;
    }

    // Moves from each of the largest errors to the largest nearby, by steps that become shorter.
    void climb() {
        std::vector<SearchPoint> starts =
            largest_in_cells(static_cast<std::size_t>(counts_.climbs));
        for (const double step : {0.5, 0.25, 0.25, 0.125}) {
            std::vector<SearchRow> rows;
            std::vector<std::size_t> start_of_row;
            for (std::size_t i = 0; i < starts.size(); ++i) {
                for (SearchRow& row : rows_around(starts[i], step)) {
                    rows.push_back(std::move(row));
                    start_of_row.push_back(i);
                }
            }
            std::vector<std::size_t> start_of_point;
            for (std::size_t k = 0; k < rows.size(); ++k) {
                start_of_point.insert(start_of_point.end(), rows[k].points.size(), start_of_row[k]);
            }
            const std::size_t first = evaluate(std::move(rows), searched());
            if (options_.cancelled()) return;
            for (std::size_t k = first; k < measured_.size(); ++k) {
                SearchPoint& start = starts[start_of_point[k - first]];
                if (measured_[k].error.largest > start.error.largest) start = measured_[k];
            }
        }
    }

    // Points beside a place, in its own row and in those beside it.
    std::vector<SearchRow> rows_around(const SearchPoint& from, double step) const {
        SearchRow own;
        own.at = from.row;
        for (std::size_t axis = 0; axis < search_.points.axes(); ++axis) {
            for (const double side : {-step, step}) {
                own.points.push_back(search_.points.moved(from.point, axis, side));
            }
        }
        std::vector<SearchRow> rows;
        for (std::size_t axis = 0; axis < search_.rows.axes(); ++axis) {
            for (const double side : {-step, step}) {
                SearchRow beside = own;
                beside.at = search_.rows.moved(from.row, axis, side);
                beside.points.push_back(from.point);
                rows.push_back(std::move(beside));
            }
        }
        if (!own.points.empty()) rows.push_back(std::move(own));
        for (SearchRow& row : rows) row.weights.assign(row.points.size(), 0);
        return rows;
    }

    // The largest error of each cell, the largest first.
    std::vector<SearchPoint> largest_in_cells(std::size_t count) const {
        std::vector<double> sizes;
        for (const SearchPoint& point : measured_) sizes.push_back(point.error.largest);
        std::vector<SearchPoint> result;
        std::set<std::pair<std::size_t, std::size_t>> cells;
        for (const std::size_t i : largest_of(sizes, sizes.size())) {
            if (result.size() >= count) break;
            const SearchPoint& point = measured_[i];
            if (!cells
                     .insert({search_.rows.cell_at(point.row), search_.points.cell_at(point.point)})
                     .second) {
                continue;
            }
            result.push_back(point);
        }
        return result;
    }

    double mean_square() const {
        double sum = 0;
        for (const SearchPoint& point : measured_) sum += point.weight * point.error.mean_square;
        return sum;
    }

    FoundErrors figures_of(const std::vector<SearchPoint>& points, double mean_square) const {
        FoundErrors found;
        found.points = static_cast<int>(points.size());
        for (const SearchPoint& point : points) {
            if (point.error.largest <= found.figures.max) continue;
            found.figures.max = point.error.largest;
            found.worst_row = point.row;
            found.worst_point = point.point;
        }
        found.figures.rms = std::sqrt(std::max(mean_square, 0.0));
        return found;
    }

    // Evaluates the reference where the estimate found the largest errors, and at points drawn from
    // those of the mean square, which it corrects by their differences.
    FoundErrors confirm() {
        const double estimated = mean_square();
        const int half = counts_.exact / 2;
        std::vector<SearchPoint> points = largest_in_cells(static_cast<std::size_t>(half));
        const std::size_t first = points.size();
        std::vector<double> weights;
        std::vector<double> squares;
        for (const SearchPoint& point : measured_) {
            weights.push_back(point.weight);
            squares.push_back(point.error.mean_square);
        }
        std::vector<double> weights_of_draws;
        for (const Draw& drawn : draw(weights, squares, counts_.exact - half, 0.5)) {
            points.push_back(measured_[drawn.index]);
            weights_of_draws.push_back(drawn.weight);
        }
        const std::vector<SearchPoint> exact = exactly(points);
        double correction = 0;
        for (std::size_t k = first; k < points.size(); ++k) {
            correction += weights_of_draws[k - first] *
                          (exact[k].error.mean_square - points[k].error.mean_square);
        }
        return figures_of(exact, estimated + correction);
    }

    // The points with the reference's errors; points of a row are evaluated together.
    std::vector<SearchPoint> exactly(std::vector<SearchPoint> points) {
        std::map<SearchPlace, std::vector<std::size_t>> of_rows;
        for (std::size_t k = 0; k < points.size(); ++k) of_rows[points[k].row].push_back(k);
        std::vector<SearchRow> rows;
        std::vector<std::size_t> order;
        for (const auto& [at, members] : of_rows) {
            SearchRow row;
            row.at = at;
            for (const std::size_t k : members) row.points.push_back(points[k].point);
            row.weights.assign(row.points.size(), 0);
            rows.push_back(std::move(row));
            order.insert(order.end(), members.begin(), members.end());
        }
        const std::size_t first = evaluate(std::move(rows), search_.exact);
        for (std::size_t k = 0; k < order.size(); ++k) {
            points[order[k]].error = measured_[first + k].error;
        }
        return points;
    }

    const LookupSearch& search_;
    const SearchCounts& counts_;
    const BakeOptions& options_;
    std::vector<double> row_shares_;
    std::vector<double> point_shares_;
    std::vector<double> row_squares_;
    std::vector<double> row_peaks_;
    double first_share_ = 1;  // of the first rows in the mean square
    double scale_ = 1;        // of expected squares
    std::map<std::pair<std::size_t, std::size_t>, double> found_;  // squares, by row and point cell
    std::vector<SearchPoint> measured_;
};

}  // namespace

std::vector<double> even_edges(int cells) {
    std::vector<double> edges;
    for (int i = 0; i <= cells; ++i) edges.push_back(static_cast<double>(i) / cells);
    return edges;
}

FoundErrors search_errors(const LookupSearch& search, const SearchCounts& counts,
                          const BakeOptions& options) {
    return ErrorSearch(search, counts, options).run();
}

}  // namespace skybake
