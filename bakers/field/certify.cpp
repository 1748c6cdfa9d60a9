#include "bakers/field/certify.h"

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <utility>

#include "bakers/field/interpolation.h"
#include "bakers/field/stored_voxels.h"
#include "bakers/math/parallel.h"

namespace skybake {
namespace {

using Values = std::vector<std::vector<double>>;

// Evaluates a function of (y, x[], out) at all points.
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

// Compares values with the reference values of the points, in the order of the points.
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

using Coordinates = std::array<double, 3>;

std::vector<double> look_up(const StoredVoxels& voxels, const Level& level,
                            const Coordinates& uvw) {
    const std::array<VoxelTap, 8> taps = trilinear_taps(level.size, uvw, level.repeats);
    const std::vector<float> values = voxels.at(taps);
    std::vector<double> result(voxels.channels(), 0.0);
    for (std::size_t i = 0; i < 8; ++i) {
        for (std::size_t c = 0; c < result.size(); ++c) {
            result[c] += taps[i].weight * double{values[i * result.size() + c]};
        }
    }
    return result;
}

// Compares lookups with the reference at places, in tiles.
VolumeErrors measure(const Level& level, PixelType type, const VolumeReference& reference,
                     const std::vector<Coordinates>& places, const VolumeComparison& comparison,
                     const BakeOptions& options) {
    const StoredVoxels voxels(level, type);
    std::vector<std::vector<double>> errors(places.size());
    std::vector<std::vector<double>> noise(places.size());
    constexpr int kTile = 32;
    const auto count = static_cast<int>(places.size());
    for_each_tile((count + kTile - 1) / kTile, options, "certify", [&](int tile) {
        for (int i = tile * kTile; i < std::min(count, (tile + 1) * kTile); ++i) {
            if (options.cancelled()) return;
            const auto at = static_cast<std::size_t>(i);
            const std::vector<double> found = look_up(voxels, level, places[at]);
            const std::vector<double> wanted = reference(places[at]);
            errors[at] = comparison.errors ? comparison.errors(places[at], found, wanted)
                                           : shares_of_range(level, found, wanted);
            noise[at].resize(errors[at].size());
            if (comparison.noise) noise[at] = comparison.noise(wanted);
        }
    });
    VolumeErrors result;
    result.points = count;
    ErrorStatistics statistics;
    for (std::size_t i = 0; i < errors.size(); ++i) {
        for (std::size_t c = 0; c < errors[i].size(); ++c) {
            const double before = statistics.max();
            statistics.add(errors[i][c], noise[i][c]);
            if (statistics.max() > before) result.worst = places[i];
        }
    }
    result.figures = statistics.figures();
    return result;
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

std::vector<double> shares_of_range(const Level& level, const std::vector<double>& found,
                                    const std::vector<double>& wanted) {
    std::vector<double> errors;
    for (std::size_t c = 0; c < found.size(); ++c) {
        const double range = level.statistics[c].max - level.statistics[c].min;
        errors.push_back((found[c] - wanted[c]) / (range > 0 ? range : 1));
    }
    return errors;
}

std::vector<double> look_up(const Level& level, PixelType type, const std::array<double, 3>& uvw) {
    return look_up(StoredVoxels(level, type), level, uvw);
}

VolumeErrors measure_lookups(const Level& level, PixelType type, const VolumeReference& reference,
                             int count, const BakeOptions& options,
                             const VolumeComparison& comparison) {
    std::vector<Coordinates> places;
    for (int i = 0; i < count; ++i) {
        Coordinates place = low_discrepancy_point(i);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            // An axis of one voxel is looked up at the voxel's centre.
            if (level.size[axis] == 1) place[axis] = 0.5;
        }
        places.push_back(comparison.lookup_place ? comparison.lookup_place(place) : place);
    }
    return measure(level, type, reference, places, comparison, options);
}

VolumeErrors measure_voxels(const Level& level, PixelType type, const VolumeReference& reference,
                            int count, const BakeOptions& options,
                            const VolumeComparison& comparison) {
    std::vector<Coordinates> places;
    for (int i = 0; i < count; ++i) {
        Coordinates place = low_discrepancy_point(i);
        if (comparison.lookup_place) place = comparison.lookup_place(place);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            place[axis] = (std::floor(place[axis] * level.size[axis]) + 0.5) / level.size[axis];
        }
        places.push_back(place);
    }
    return measure(level, type, reference, places, comparison, options);
}

}  // namespace skybake
