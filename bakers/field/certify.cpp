#include "bakers/field/certify.h"

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <utility>

#include "bakers/field/bilinear.h"
#include "bakers/field/error_statistics.h"
#include "bakers/math/tiles.h"

namespace skybake {

namespace {

using Values = std::vector<std::vector<double>>;

// Values of a function of (y, x[], out) at all points.
template <class Function>
Values evaluate(const std::vector<PointRow>& rows, int channels, const BakeOptions& options,
                std::string_view step, const Function& function) {
    Values values(rows.size());
    for_each_tile(static_cast<int>(rows.size()), options, step, [&](int i) {
        const auto j = static_cast<std::size_t>(i);
        values[j].resize(rows[j].x.size() * static_cast<std::size_t>(channels));
        function(rows[j].y, rows[j].x, values[j].data());
    });
    return values;
}

ReferencePoints with_reference(const TableModel& model, std::vector<PointRow> rows,
                               const BakeOptions& options) {
    ReferencePoints points;
    points.values = evaluate(rows, model.channels, options, "reference", model.reference);
    points.rows = std::move(rows);
    const auto channels = static_cast<std::size_t>(model.channels);
    points.scale.assign(channels, 0);
    for (const std::vector<double>& row : points.values) {
        for (std::size_t i = 0; i < row.size(); ++i) {
            points.scale[i % channels] = std::max(points.scale[i % channels], row[i]);
        }
    }
    return points;
}

// Errors of values against the points' own, in the order of the points.
MeasuredErrors measure(const TableModel& model, const ReferencePoints& points,
                       const Values& values) {
    MeasuredErrors measured;
    ErrorStatistics statistics;
    const auto channels = static_cast<std::size_t>(model.channels);
    for (std::size_t j = 0; j < points.rows.size(); ++j) {
        for (std::size_t i = 0; i < values[j].size(); ++i) {
            const double before = statistics.max();
            statistics.add(
                model.error(values[j][i], points.values[j][i], points.scale[i % channels]));
            if (statistics.max() != before) {
                measured.worst = {points.rows[j].x[i / channels], points.rows[j].y};
            }
        }
    }
    measured.figures = statistics.figures();
    return measured;
}

}  // namespace

int ReferencePoints::count() const {
    std::size_t sum = 0;
    for (const PointRow& row : rows) sum += row.x.size();
    return static_cast<int>(sum);
}

ReferencePoints reference_points(const TableModel& model, PointCounts counts,
                                 const BakeOptions& options) {
    std::vector<PointRow> rows = low_discrepancy_points(counts.rows, counts.per_row);
    if (model.x_of_point) {
        for (PointRow& row : rows) {
            for (double& x : row.x) x = model.x_of_point(x);
        }
    }
    return with_reference(model, std::move(rows), options);
}

ReferencePoints reference_texels(const TableModel& model, std::array<int, 2> size,
                                 PointCounts counts, const BakeOptions& options) {
    std::vector<PointRow> rows;
    const auto x_of = [&](int i) { return texel_coordinate(model.convention, i, size[0]); };
    const auto y_of = [&](int j) { return texel_coordinate(model.convention, j, size[1]); };
    if (static_cast<long>(size[0]) * size[1] <= static_cast<long>(counts.rows) * counts.per_row) {
        for (int j = 0; j < size[1]; ++j) {
            PointRow row{y_of(j), {}};
            for (int i = 0; i < size[0]; ++i) row.x.push_back(x_of(i));
            rows.push_back(std::move(row));
        }
    } else {
        rows = low_discrepancy_points(counts.rows, counts.per_row);
        for (PointRow& row : rows) {
            row.y = y_of(static_cast<int>(row.y * size[1]));
            for (double& x : row.x) x = x_of(static_cast<int>(x * size[0]));
        }
    }
    return with_reference(model, std::move(rows), options);
}

MeasuredErrors measure_lookups(const TableModel& model, const Image2<float>& image,
                               const ReferencePoints& points) {
    const Values values =
        evaluate(points.rows, model.channels, BakeOptions{1}, "lookups",
                 [&](double y, const std::vector<double>& x, double* out) {
                     const double v = lookup_v(model, y, image.height);
                     for (std::size_t i = 0; i < x.size(); ++i) {
                         bilinear(image, lookup_u(model, x[i], image.width), v,
                                  out + i * static_cast<std::size_t>(model.channels));
                     }
                 });
    return measure(model, points, values);
}

MeasuredErrors measure_kernel(const TableModel& model, int level, const ReferencePoints& points,
                              const BakeOptions& options) {
    return measure(model, points,
                   evaluate(points.rows, model.channels, options, "levels",
                            [&](double y, const std::vector<double>& x, double* out) {
                                model.row(level, y, x, out);
                            }));
}

}  // namespace skybake
