// Measuring the error of a stored table: what makes an asset's figures.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "bakers/field/baked.h"
#include "bakers/field/table_model.h"
#include "bakers/math/bake_options.h"
#include "bakers/math/quadrature.h"

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

// Measuring the error of a volume as stored. Voxels are asked for one by one: the volume itself is
// never held.

// The exact values, one per channel, at texture coordinates: voxel i of an axis is at
// (i + 1/2) / size, whatever it samples. Asked for in [0, 1].
using VolumeReference = std::function<std::vector<double>(const std::array<double, 3>& uvw)>;

// How errors are measured where shares of each channel's value range would tell little. Members
// that are empty change nothing.
struct VolumeComparison {
    // The errors at texture coordinates, as many everywhere, from what was found and is wanted
    // there.
    std::function<std::vector<double>(const std::array<double, 3>& uvw,
                                      const std::vector<double>& found,
                                      const std::vector<double>& wanted)>
        errors;
    // The nearest texture coordinates to these that a lookup may have.
    std::function<std::array<double, 3>(const std::array<double, 3>& uvw)> lookup_place;
    std::string scale;  // what an error of 1 means
};

struct VolumeErrors {
    ErrorFigures figures;           // over all channels, or all errors of the comparison
    std::array<double, 3> worst{};  // texture coordinates of the largest
    int points = 0;
};

// Trilinear lookups of the voxels as stored, repeated or clamped as level.repeats says, at `count`
// points of the fixed set; at the voxel itself along axes that have but one.
VolumeErrors measure_lookups(const Level& level, config::PixelType type,
                             const VolumeReference& reference, int count,
                             const BakeOptions& options, const VolumeComparison& comparison = {});

// The voxels themselves: those that the same set falls into.
VolumeErrors measure_voxels(const Level& level, config::PixelType type,
                            const VolumeReference& reference, int count, const BakeOptions& options,
                            const VolumeComparison& comparison = {});

// What a lookup of the stored voxels finds, one value per channel.
std::vector<double> look_up(const Level& level, config::PixelType type,
                            const std::array<double, 3>& uvw);

// Maximum and root mean square of a series of errors, in the order given.
class ErrorStatistics {
  public:
    void add(double error) {
        const double size = std::fabs(error);
        if (size > max_ || std::isnan(size)) max_ = size;  // NaN stays: no bound accepts it
        sum_of_squares_ += error * error;
        ++count_;
    }
    ErrorFigures figures() const {
        return {max_, count_ == 0 ? 0 : std::sqrt(sum_of_squares_ / static_cast<double>(count_))};
    }
    double max() const { return max_; }

  private:
    double max_ = 0;
    double sum_of_squares_ = 0;
    long count_ = 0;
};

}  // namespace skybake
