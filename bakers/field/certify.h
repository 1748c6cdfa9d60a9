// Measuring the error of a stored table: what makes an asset's figures.
#pragma once

#include <array>
#include <vector>

#include "bakers/field/table_model.h"
#include "bakers/math/bake_options.h"
#include "bakers/math/low_discrepancy.h"

namespace skybake {

// How many points: rows of the table's second coordinate, and points in each. References that share
// work along a row are asked for few rows.
struct PointCounts {
    int rows = 0;
    int per_row = 0;
};

// Points at which a table is compared with its reference, and the reference's values there.
struct ReferencePoints {
    std::vector<PointRow> rows;
    std::vector<std::vector<double>> values;  // per row, channels interleaved
    std::vector<double> scale;                // per channel: the largest value over all points
    int count() const;
};

// Points of the fixed low-discrepancy set, between texels.
ReferencePoints reference_points(const TableModel& model, PointCounts counts,
                                 const BakeOptions& options);

// Texel centres: those that the same set falls into, or all where the table has no more than that.
ReferencePoints reference_texels(const TableModel& model, std::array<int, 2> size,
                                 PointCounts counts, const BakeOptions& options);

struct MeasuredErrors {
    ErrorFigures figures;
    std::array<double, 2> worst{};  // x, y of the largest error
};

// Bilinear lookups of the stored image at the points, as a runtime makes them.
MeasuredErrors measure_lookups(const TableModel& model, const Image2<float>& image,
                               const ReferencePoints& points);

// The kernel itself at the points, at a quadrature level: what no table can undercut.
MeasuredErrors measure_kernel(const TableModel& model, int level, const ReferencePoints& points,
                              const BakeOptions& options);

}  // namespace skybake
