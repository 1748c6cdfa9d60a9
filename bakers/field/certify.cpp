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
            const double error =
                model.error(values[j][i], points.values[j][i], points.scale[i % channels]);
            if (statistics.add(error)) {
                measured.worst = {points.rows[j].x[i / channels], points.rows[j].y};
            }
        }
    }
    measured.figures = statistics.figures();
    return measured;
}

using Coordinates = std::array<double, 3>;

struct Lookup {
    std::vector<double> values;
    double filled = 0;  // the share of the taps whose first channel is not 0
};

Lookup look_up(const StoredVoxels& voxels, const Level& level, const Coordinates& uvw) {
    const std::array<VoxelTap, 8> taps = trilinear_taps(level.size, uvw, level.repeats);
    const std::vector<float> values = voxels.at(taps);
    Lookup result{std::vector<double>(voxels.channels(), 0.0)};
    for (std::size_t i = 0; i < 8; ++i) {
        const float* tap = &values[i * voxels.channels()];
        result.filled += *tap != 0 ? 1.0 / 8 : 0;
        for (std::size_t c = 0; c < voxels.channels(); ++c) {
            result.values[c] += taps[i].weight * double{tap[c]};
        }
    }
    return result;
}

// Where lookups are compared with the reference.
struct Places {
    std::vector<Coordinates> uvw;
    double beside_filled = 0;  // the share of them that are chosen so (place_beside)

    // The weight of a place in the mean of squares, one over how densely places lie about it.
    double weight(const Level& level, const Lookup& lookup) const {
        if (beside_filled == 0) return 1;
        return 1 / (1 - beside_filled + beside_filled * lookup.filled / level.filled.share);
    }
};

// A place whose lookup has the voxel among its taps. `within` goes evenly over all of them.
Coordinates place_beside(const std::array<int, 3>& voxel, const Coordinates& within,
                         const Level& level) {
    Coordinates uvw;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double at = (voxel[axis] - 0.5 + 2 * within[axis]) / level.size[axis];
        // Beyond an end that is clamped lies what is before it.
        uvw[axis] = level.repeats[axis] ? at - std::floor(at) : 1 - std::fabs(1 - std::fabs(at));
    }
    return uvw;
}

// Compares lookups with the reference at places, in tiles.
VolumeErrors measure(const Level& level, PixelType type, const VolumeReference& reference,
                     const Places& places, const VolumeComparison& comparison,
                     const BakeOptions& options) {
    const StoredVoxels voxels(level, type);
    std::vector<std::vector<double>> errors(places.uvw.size());
    std::vector<std::vector<double>> noise(places.uvw.size());
    std::vector<double> weights(places.uvw.size());
    constexpr int kTile = 32;
    const auto count = static_cast<int>(places.uvw.size());
    for_each_tile((count + kTile - 1) / kTile, options, "certify", [&](int tile) {
        for (int i = tile * kTile; i < std::min(count, (tile + 1) * kTile); ++i) {
            if (options.cancelled()) return;
            const auto at = static_cast<std::size_t>(i);
            const Lookup lookup = look_up(voxels, level, places.uvw[at]);
            weights[at] = places.weight(level, lookup);
            const std::vector<double> wanted = reference(places.uvw[at]);
            errors[at] = errors_of(level, comparison, places.uvw[at], lookup.values, wanted);
            noise[at].resize(errors[at].size());
            if (comparison.noise) noise[at] = comparison.noise(wanted);
        }
    });
    VolumeErrors result;
    result.points = count;
    ErrorStatistics statistics;
    for (std::size_t i = 0; i < errors.size(); ++i) {
        for (std::size_t c = 0; c < errors[i].size(); ++c) {
            if (statistics.add(errors[i][c], noise[i][c], weights[i])) {
                result.worst = places.uvw[i];
            }
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

std::vector<double> errors_of(const Level& level, const VolumeComparison& comparison,
                              const std::array<double, 3>& uvw, const std::vector<double>& found,
                              const std::vector<double>& wanted) {
    if (comparison.errors) return comparison.errors(uvw, found, wanted);
    std::vector<double> errors;
    for (std::size_t c = 0; c < found.size(); ++c) {
        const double range = level.statistics[c].max - level.statistics[c].min;
        errors.push_back((found[c] - wanted[c]) / (range > 0 ? range : 1));
    }
    return errors;
}

std::vector<double> look_up(const Level& level, PixelType type, const std::array<double, 3>& uvw) {
    return look_up(StoredVoxels(level, type), level, uvw).values;
}

VolumeErrors measure_lookups(const Level& level, PixelType type, const VolumeReference& reference,
                             int count, const BakeOptions& options,
                             const VolumeComparison& comparison) {
    const std::vector<std::array<int, 3>>& filled = level.filled.some;
    const bool is_sparse = level.filled.share < 0.5 && !filled.empty() && !comparison.lookup_place;
    const int beside = is_sparse ? count / 2 : 0;
    Places places{{}, static_cast<double>(beside) / count};
    for (int i = 0; i < count; ++i) {
        Coordinates place = low_discrepancy_point(i);
        if (i < beside) {
            const auto chosen = static_cast<std::size_t>(i) * filled.size();
            place = place_beside(filled[chosen / static_cast<std::size_t>(beside)], place, level);
        }
        for (std::size_t axis = 0; axis < 3; ++axis) {
            // An axis of one voxel is looked up at the voxel's centre.
            if (level.size[axis] == 1) place[axis] = 0.5;
        }
        places.uvw.push_back(comparison.lookup_place ? comparison.lookup_place(place) : place);
    }
    return measure(level, type, reference, places, comparison, options);
}

VolumeErrors measure_voxels(const Level& level, PixelType type, const VolumeReference& reference,
                            int count, const BakeOptions& options,
                            const VolumeComparison& comparison) {
    Places places;
    for (int i = 0; i < count; ++i) {
        Coordinates place = low_discrepancy_point(i);
        if (comparison.lookup_place) place = comparison.lookup_place(place);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            place[axis] = (std::floor(place[axis] * level.size[axis]) + 0.5) / level.size[axis];
        }
        places.uvw.push_back(place);
    }
    return measure(level, type, reference, places, comparison, options);
}

}  // namespace skybake
