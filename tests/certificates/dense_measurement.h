// Dense measurements of tables, which share nothing with the search that certificates are made of.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "bakers/field/certify.h"
#include "bakers/field/interpolation.h"
#include "bakers/field/table_model.h"
#include "tests/certificates/random_cases.h"

namespace skybake::test {

// Coordinates of a dense axis, and the weights of those that are spread evenly; points close to
// the ends and the middle, where horizons and terminators lie, have none.
struct DenseAxis {
    std::vector<double> at;
    std::vector<double> weights;
};

inline DenseAxis dense_axis(int even, RandomCase& random) {
    DenseAxis axis;
    for (int i = 0; i < even; ++i) {
        axis.at.push_back((i + random.uniform(0, 1)) / even);
        axis.weights.push_back(1.0 / even);
    }
    for (double distance = 0.1; even > 1 && distance > 1e-4; distance /= 2) {
        for (const double place : {distance, 0.5 - distance, 0.5 + distance, 1 - distance}) {
            axis.at.push_back(place);
            axis.weights.push_back(0);
        }
    }
    return axis;
}

// The largest error and the root mean square of any points, whose largest few are measured again.
class DenseErrors {
  public:
    struct Point {
        std::array<std::size_t, 4> at{};
        double largest = 0;
    };

    void add(const std::array<std::size_t, 4>& at, double weight, double largest,
             double mean_square) {
        points_.push_back({at, largest});
        mean_square_ += weight * mean_square;
    }

    // `exactly` returns the largest error at a point against the reference itself.
    ErrorFigures figures(const std::function<double(const Point&)>& exactly) {
        constexpr std::ptrdiff_t kAgain = 12;
        const auto end = points_.begin() + std::min<std::ptrdiff_t>(
                                               kAgain, static_cast<std::ptrdiff_t>(points_.size()));
        std::partial_sort(points_.begin(), end, points_.end(),
                          [](const Point& a, const Point& b) { return a.largest > b.largest; });
        ErrorFigures figures;
        for (auto point = points_.begin(); point != end; ++point) {
            figures.max = std::max(figures.max, exactly(*point));
        }
        figures.rms = std::sqrt(mean_square_);
        return figures;
    }

  private:
    std::vector<Point> points_;
    double mean_square_ = 0;
};

using ValueRow = std::function<void(double y, const std::vector<double>& x, double* values)>;

// Measures lookups of a table at `per_texel` points along each axis of each texel against `row`,
// and the worst of these against the model's reference.
inline ErrorFigures measure_densely(const TableModel& model, const Image2<float>& image,
                                    const ValueRow& row, int per_texel, RandomCase& random) {
    const auto channels = static_cast<std::size_t>(model.channels);
    const DenseAxis x = dense_axis(per_texel * image.width, random);
    const DenseAxis y = dense_axis(image.height == 1 ? 1 : per_texel * image.height, random);
    std::vector<std::vector<double>> values(y.at.size(),
                                            std::vector<double>(x.at.size() * channels));
    std::vector<double> scale(channels, 0);
    for (std::size_t j = 0; j < y.at.size(); ++j) {
        row(y.at[j], x.at, values[j].data());
        for (std::size_t i = 0; i < values[j].size(); ++i) {
            scale[i % channels] = std::max(scale[i % channels], values[j][i]);
        }
    }
    const auto error_at = [&](std::size_t i, std::size_t j, const double* wanted, double* square) {
        std::vector<double> found(channels);
        bilinear(image, lookup_u(model, x.at[i], image.width),
                 lookup_v(model, y.at[j], image.height), found.data());
        double largest = 0;
        for (std::size_t c = 0; c < channels; ++c) {
            const double error = model.error(found[c], wanted[c], scale[c]);
            largest = std::max(largest, std::fabs(error));
            *square += error * error / static_cast<double>(channels);
        }
        return largest;
    };
    DenseErrors errors;
    for (std::size_t j = 0; j < y.at.size(); ++j) {
        for (std::size_t i = 0; i < x.at.size(); ++i) {
            double square = 0;
            const double largest = error_at(i, j, &values[j][i * channels], &square);
            errors.add({i, j}, x.weights[i] * y.weights[j], largest, square);
        }
    }
    return errors.figures([&](const DenseErrors::Point& point) {
        std::vector<double> wanted(channels);
        double square = 0;
        model.reference(y.at[point.at[1]], {x.at[point.at[0]]}, wanted.data());
        return error_at(point.at[0], point.at[1], wanted.data(), &square);
    });
}

// What `rows` x `per_row` points spread evenly would claim against the same values.
inline ErrorFigures claimed_by_even_points(TableModel model, const Image2<float>& image,
                                           const ValueRow& row, PointCounts counts) {
    model.reference = row;
    return measure_lookups(model, image, reference_points(model, counts, BakeOptions{1})).figures;
}

}  // namespace skybake::test
