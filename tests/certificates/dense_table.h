// Dense measurements of tables, which share nothing with the search that certificates are made of.
//
// Often one texel in a hundred, at a terminator or a horizon, holds most of the mean square. A few
// points in each texel then measure little but chance: measured twice with 3 x 3 points, the root
// mean square of some tables differs by a factor of two. So the texels that hold most of it, and
// those around them, are measured again with more points.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <set>
#include <vector>

#include "bakers/field/certify.h"
#include "bakers/field/interpolation.h"
#include "bakers/field/table_model.h"
#include "tests/certificates/dense_measurement.h"
#include "tests/certificates/random_cases.h"

namespace skybake::test {

// Values at (x[i], y), channels interleaved.
using ValueRow = std::function<void(double y, const std::vector<double>& x, double* values)>;

class DenseTable {
  public:
    DenseTable(const TableModel& model, const Image2<float>& image, const ValueRow& row,
               RandomCase& random)
        : model_(model), image_(image), row_(row), random_(random) {}

    // The largest errors are those against the model's reference.
    ErrorFigures figures() {
        measure_everywhere();
        measure_again(texels_that_hold_most(), 12);
        measure_again(texels_that_hold_much(), 48);
        double sum = 0;
        for (const double square : squares_) sum += square;
        return {largest_.figure([&](const Place& at) { return exactly(at); }),
                std::sqrt(sum / static_cast<double>(squares_.size()))};
    }

  private:
    using Place = std::array<double, 2>;  // x, y

    // In each texel three points along each axis. Further points lie close to the ends and the
    // middle, where horizons and terminators are; they count for the largest error alone.
    void measure_everywhere() {
        constexpr int kPieces = 3;
        std::vector<std::vector<double>> values;
        std::vector<double> x = spread(all(image_.width), image_.width, kPieces);
        std::vector<double> y = spread(all(image_.height), image_.height, kPieces);
        const std::size_t columns = x.size();
        const std::size_t rows = y.size();
        add_special(x);
        if (image_.height > 1) add_special(y);
        for (const double at : y) values.push_back(values_at(at, x));
        scale_.assign(channels(), 0);
        for (std::size_t i = 0; i < image_.texels.size(); ++i) {
            double& scale = scale_[i % channels()];
            scale = std::max(scale, double{image_.texels[i]});
        }
        squares_.assign(texel(0, image_.height), 0);
        for (std::size_t j = 0; j < y.size(); ++j) {
            for (std::size_t i = 0; i < x.size(); ++i) {
                const double square = add(x[i], y[j], &values[j][i * channels()]);
                if (i >= columns || j >= rows) continue;
                squares_[texel(static_cast<int>(i) / kPieces, static_cast<int>(j) / kPieces)] +=
                    square / (kPieces * kPieces);
            }
        }
    }

    // The texels with the largest squares, which hold 95 % of their sum, and those around them: the
    // columns of each row.
    std::vector<std::set<int>> texels_that_hold_most() const {
        std::vector<std::set<int>> columns(static_cast<std::size_t>(image_.height));
        for (const std::size_t i : largest_holding(0.95, squares_)) {
            const int x = static_cast<int>(i) % image_.width;
            const int y = static_cast<int>(i) / image_.width;
            for (int row = std::max(y - 1, 0); row <= std::min(y + 1, image_.height - 1); ++row) {
                for (int c = std::max(x - 1, 0); c <= std::min(x + 1, image_.width - 1); ++c) {
                    columns[static_cast<std::size_t>(row)].insert(c);
                }
            }
        }
        return columns;
    }

    // The texels that hold more than a twentieth each.
    std::vector<std::set<int>> texels_that_hold_much() const {
        const double sum = std::accumulate(squares_.begin(), squares_.end(), 0.0);
        std::vector<std::set<int>> columns(static_cast<std::size_t>(image_.height));
        for (std::size_t i = 0; i < squares_.size(); ++i) {
            if (squares_[i] <= 0.05 * sum) continue;
            columns[i / static_cast<std::size_t>(image_.width)].insert(static_cast<int>(i) %
                                                                       image_.width);
        }
        return columns;
    }

    // With `pieces` points along each axis of the texels in these columns of each row.
    void measure_again(const std::vector<std::set<int>>& columns_of_rows, int pieces) {
        for (int row = 0; row < image_.height; ++row) {
            const std::set<int>& chosen = columns_of_rows[static_cast<std::size_t>(row)];
            if (chosen.empty()) continue;
            const std::vector<int> columns(chosen.begin(), chosen.end());
            for (const int column : columns) squares_[texel(column, row)] = 0;
            for (const double y : spread({row}, image_.height, pieces)) {
                const std::vector<double> x = spread(columns, image_.width, pieces);
                const std::vector<double> values = values_at(y, x);
                for (std::size_t i = 0; i < x.size(); ++i) {
                    squares_[texel(columns[i / static_cast<std::size_t>(pieces)], row)] +=
                        add(x[i], y, &values[i * channels()]) / (pieces * pieces);
                }
            }
        }
    }

    std::size_t channels() const { return static_cast<std::size_t>(model_.channels); }
    std::size_t texel(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(image_.width) +
               static_cast<std::size_t>(column);
    }

    static std::vector<int> all(int count) {
        std::vector<int> indices;
        for (int i = 0; i < count; ++i) indices.push_back(i);
        return indices;
    }

    // A random place in each of as many equal pieces of each of these texels.
    std::vector<double> spread(const std::vector<int>& texels, int count, int pieces) {
        std::vector<double> places;
        for (const int texel : texels) {
            for (int i = 0; i < pieces; ++i) {
                places.push_back((texel * pieces + i + random_.uniform(0, 1)) / (count * pieces));
            }
        }
        return places;
    }

    static void add_special(std::vector<double>& places) {
        for (double distance = 0.1; distance > 1e-4; distance /= 2) {
            for (const double place : {distance, 0.5 - distance, 0.5 + distance, 1 - distance}) {
                places.push_back(place);
            }
        }
    }

    // The x at which a place is looked up.
    double x_of(double place) const { return model_.x_of_point ? model_.x_of_point(place) : place; }

    std::vector<double> values_at(double y, std::vector<double> x) const {
        std::vector<double> values(x.size() * channels());
        for (double& place : x) place = x_of(place);
        row_(y, x, values.data());
        return values;
    }

    PointError error_at(const Place& at, const double* wanted) const {
        std::vector<double> found(channels());
        bilinear(image_, lookup_u(model_, x_of(at[0]), image_.width),
                 lookup_v(model_, at[1], image_.height), found.data());
        for (std::size_t c = 0; c < channels(); ++c) {
            found[c] = model_.error(found[c], wanted[c], scale_[c]);
        }
        return PointError::of(found.data(), channels());
    }

    // Returns the mean square over the channels.
    double add(double x, double y, const double* wanted) {
        const PointError error = error_at({x, y}, wanted);
        largest_.add({x, y}, error.largest);
        return error.mean_square;
    }

    double exactly(const Place& at) const {
        std::vector<double> wanted(channels());
        model_.reference(at[1], {x_of(at[0])}, wanted.data());
        return error_at(at, wanted.data()).largest;
    }

    const TableModel& model_;
    const Image2<float>& image_;
    const ValueRow& row_;
    RandomCase& random_;
    std::vector<double> scale_;
    std::vector<double> squares_;  // means over each texel
    LargestErrors<Place> largest_;
};

// Returns the claim of `rows` x `per_row` points spread evenly against the same values.
inline ErrorFigures claimed_by_even_points(TableModel model, const Image2<float>& image,
                                           const ValueRow& row, PointCounts counts) {
    model.reference = row;
    return measure_lookups(model, image, reference_points(model, counts, BakeOptions{1})).figures;
}

}  // namespace skybake::test
