#include "bakers/field/error_search.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "bakers/field/search_draws.h"
#include "bakers/math/parallel.h"

namespace skybake {

std::vector<double> even_edges(int cells) {
    std::vector<double> edges;
    for (int i = 0; i <= cells; ++i) edges.push_back(static_cast<double>(i) / cells);
    return edges;
}

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

class ErrorSearch {
  public:
    ErrorSearch(const LookupSearch& search, const SearchCounts& counts, const BakeOptions& options)
        : search_(search), counts_(counts), options_(options), draws_(search, options.threads) {}

    FoundErrors run() {
        const int first = std::max(1, counts_.rows / 4);
        const double first_share = first < counts_.rows ? kFirstShare : 1;
        std::vector<SearchRow> rows = draws_.rows(first, counts_.per_row, first_share);
        for (SearchRow& row : draws_.peak_rows(counts_.peak_rows, counts_.per_row)) {
            rows.push_back(std::move(row));
        }
        evaluate(std::move(rows), searched());
        // After an interruption rows were skipped, so that there may be no points at all.
        if (options_.cancelled()) return {};
        climb();
        if (options_.cancelled()) return {};
        draws_.learn(measured_, mean_square() / first_share);
        evaluate(draws_.rows(counts_.rows - first, counts_.per_row, 1 - first_share), searched());
        if (options_.cancelled()) return {};
        return search_.estimate ? confirm() : figures_of(measured_, mean_square());
    }

  private:
    const RowErrors& searched() const {
        return search_.estimate ? search_.estimate : search_.exact;
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
        if (options_.cancelled()) return points;
        for (std::size_t k = 0; k < order.size(); ++k) {
            points[order[k]].error = measured_[first + k].error;
        }
        return points;
    }

    const LookupSearch& search_;
    const SearchCounts& counts_;
    const BakeOptions& options_;
    SearchDraws draws_;
    std::vector<SearchPoint> measured_;
};

}  // namespace

FoundErrors search_errors(const LookupSearch& search, const SearchCounts& counts,
                          const BakeOptions& options) {
    return ErrorSearch(search, counts, options).run();
}

}  // namespace skybake
