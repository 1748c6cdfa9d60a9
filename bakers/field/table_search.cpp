#include <algorithm>
#include <cmath>
#include <utility>

#include "bakers/field/certify.h"
#include "bakers/field/interpolation.h"

namespace skybake {
namespace {

// Cells of an axis whose measured points are not spread as its texels: as many for each texel.
constexpr int kCellsOfTexel = 2;

// The coordinates between which lookups interpolate, or are clamped to one texel.
std::vector<double> cell_edges(TexelConvention convention, int count) {
    if (count == 1) return {0, 1};
    std::vector<double> edges;
    for (int i = 0; i < count; ++i) edges.push_back(texel_coordinate(convention, i, count));
    if (edges.front() > 0) edges.insert(edges.begin(), 0);
    if (edges.back() < 1) edges.push_back(1);
    return edges;
}

std::vector<double> column_edges(const TableModel& model, int columns) {
    return model.x_of_point ? even_edges(kCellsOfTexel * columns)
                            : cell_edges(model.convention, columns);
}

std::vector<double> row_edges(const TableModel& model, int rows) {
    std::vector<double> edges = cell_edges(model.convention, rows);
    const auto half = std::ranges::lower_bound(edges, 0.5);
    // Lookups on the two sides of the middle read different rows.
    if (model.v_of && *half != 0.5) edges.insert(half, 0.5);
    return edges;
}

// Where a cell's lookups lie along one axis: the two texels that they blend, or only one.
struct CellTexels {
    int first = 0;
    int second = 0;
};

CellTexels texels_between(double low, double high, int count) {
    const double last = count - 1;
    const double from = std::clamp(low * count - 0.5, 0.0, last);
    const double to = std::clamp(high * count - 0.5, 0.0, last);
    const int first = std::min(static_cast<int>(0.5 * (from + to)), count - 1);
    return {first, to > from ? std::min(first + 1, count - 1) : first};
}

// Returns twice the largest distance of the curve through texels `first` and `second` of a line
// from the straight line between them, by its second differences over texels low ... high; of the
// end of a line, by its first difference.
template <class Line>
double bend(const Line& line, CellTexels at, int low, int high) {
    if (high - low < 2) return high > low ? std::fabs(line(high) - line(low)) : 0;
    if (at.first == at.second) {
        const int inside = at.first == low ? low + 1 : at.first - 1;
        return std::fabs(line(inside) - line(at.first));
    }
    double largest = 0;
    for (const int texel : {at.first, at.second}) {
        const int middle = std::clamp(texel, low + 1, high - 1);
        largest =
            std::max(largest, std::fabs(line(middle - 1) - 2 * line(middle) + line(middle + 1)));
    }
    return largest / 4;
}

// Estimates the errors in the cells of texels: the error of a value that is off by half the bends along
// both axes.
class TexelBends {
  public:
    TexelBends(const TableModel& model, const Image2<float>& image, std::vector<double> scale)
        : model_(model), image_(image), scale_(std::move(scale)) {
        const std::vector<double> x = column_edges(model, image.width);
        for (std::size_t i = 0; i + 1 < x.size(); ++i) {
            columns_.push_back(texels_between(lookup_u(model, inside(x, i, 0.25), image.width),
                                              lookup_u(model, inside(x, i, 0.75), image.width),
                                              image.width));
        }
        const std::vector<double> y = row_edges(model, image.height);
        for (std::size_t j = 0; j + 1 < y.size(); ++j) {
            rows_.push_back(texels_between(lookup_v(model, inside(y, j, 0.25), image.height),
                                           lookup_v(model, inside(y, j, 0.75), image.height),
                                           image.height));
        }
    }

    double expected(std::size_t row, std::size_t column) const {
        const CellTexels across = columns_[column];
        const CellTexels up = rows_[row];
        const auto [low, high] = blended_rows(up.first);
        double largest = 0;
        for (int c = 0; c < image_.channels; ++c) {
            const auto at = [&](int x, int y) { return double{image_.texel(x, y)[c]}; };
            double off = 0;
            for (const int y : {up.first, up.second}) {
                off = std::max(off,
                               bend([&](int x) { return at(x, y); }, across, 0, image_.width - 1));
            }
            double off_up = 0;
            for (const int x : {across.first, across.second}) {
                off_up = std::max(off_up, bend([&](int y) { return at(x, y); }, up, low, high));
            }
            const double mean = 0.25 * (at(across.first, up.first) + at(across.second, up.first) +
                                        at(across.first, up.second) + at(across.second, up.second));
            const double error = model_.error(mean + 0.5 * (off + off_up), mean,
                                              scale_[static_cast<std::size_t>(c)]);
            if (std::isfinite(error)) largest = std::max(largest, std::fabs(error));
        }
        return largest;
    }

  private:
    static double inside(const std::vector<double>& edges, std::size_t i, double share) {
        return edges[i] + share * (edges[i + 1] - edges[i]);
    }

    // The first and the last row of those that lookups may blend with a row.
    std::pair<int, int> blended_rows(int row) const {
        if (!model_.v_of) return {0, image_.height - 1};
        const int upper = image_.height / 2;
        return row < upper ? std::pair{0, upper - 1} : std::pair{upper, image_.height - 1};
    }

    const TableModel& model_;
    const Image2<float>& image_;
    std::vector<double> scale_;
    std::vector<CellTexels> columns_;
    std::vector<CellTexels> rows_;
};

std::vector<double> largest_texels(const Image2<float>& image) {
    const auto channels = static_cast<std::size_t>(image.channels);
    std::vector<double> largest(channels, 0);
    for (std::size_t i = 0; i < image.texels.size(); ++i) {
        largest[i % channels] = std::max(largest[i % channels], double{image.texels[i]});
    }
    return largest;
}

// Values at (x[i], y), channels interleaved.
using ValueRow = std::function<void(double y, const std::vector<double>& x, double* values)>;

RowErrors errors_against(const TableModel& model, const Image2<float>& image,
                         const std::vector<double>& scale, ValueRow wanted) {
    return [&model, &image, scale, wanted = std::move(wanted)](
               const SearchPlace& row, const std::vector<SearchPlace>& points, PointError* errors) {
        const auto channels = static_cast<std::size_t>(model.channels);
        const double y = row[0];
        std::vector<double> x;
        for (const SearchPlace& point : points) {
            x.push_back(model.x_of_point ? model.x_of_point(point[0]) : point[0]);
        }
        std::vector<double> values(x.size() * channels);
        wanted(y, x, values.data());
        const double v = lookup_v(model, y, image.height);
        std::vector<double> found(channels);
        for (std::size_t i = 0; i < x.size(); ++i) {
            bilinear(image, lookup_u(model, x[i], image.width), v, found.data());
            for (std::size_t c = 0; c < channels; ++c) {
                found[c] = model.error(found[c], values[i * channels + c], scale[c]);
            }
            errors[i] = PointError::of(found.data(), channels);
        }
    };
}

}  // namespace

FoundErrors search_table(const TableModel& model, int level, const Image2<float>& image,
                         const SearchCounts& counts, const BakeOptions& options) {
    const std::vector<double> scale = largest_texels(image);
    LookupSearch search = {SearchGrid({row_edges(model, image.height)}),
                           SearchGrid({column_edges(model, image.width)}),
                           errors_against(model, image, scale, model.reference),
                           {},
                           {}};
    if (counts.exact > 0) {
        search.estimate =
            errors_against(model, image, scale,
                           [&model, level](double y, const std::vector<double>& x, double* values) {
                               model.row(level, y, x, values);
                           });
    }
    const TexelBends bends(model, image, scale);
    if (!model.x_of_point) {
        search.expected = [&bends](std::size_t row, std::size_t column) {
            return bends.expected(row, column);
        };
    }
    return search_errors(search, counts, options);
}

}  // namespace skybake
