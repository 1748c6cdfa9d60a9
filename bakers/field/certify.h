// Measures the errors of stored tables and volumes against their references. Certificates and
// reports show the results.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "bakers/field/conventions.h"
#include "bakers/field/error_search.h"
#include "bakers/field/level.h"
#include "bakers/field/table_model.h"
#include "bakers/math/bake_options.h"
#include "bakers/math/quadrature.h"
#include "config/sections/pixel_types.h"

namespace skybake {

// The number of points at which a table is compared: rows (values of the table's second coordinate)
// and points in each row. A reference that shares work along a row is evaluated in few rows.
struct PointCounts {
    int rows = 0;
    int per_row = 0;
};

// Points at which a table is compared with its reference, and the reference's values there.
struct ReferencePoints {
    std::vector<PointRow> rows;
    std::vector<std::vector<double>> values;  // one vector per row, channels interleaved
    std::vector<double> scale;                // the largest value of each channel over all points
    int count() const;
};

// Returns points of the fixed low-discrepancy set, which lie between texels.
ReferencePoints reference_points(const TableModel& model, PointCounts counts,
                                 const BakeOptions& options);

// Returns the centres of the texels that the same set falls into, or all texel centres if the table
// has no more texels than the set has points.
ReferencePoints reference_texels(const TableModel& model, std::array<int, 2> size,
                                 PointCounts counts, const BakeOptions& options);

struct MeasuredErrors {
    ErrorFigures figures;
    std::array<double, 2> worst{};  // x, y of the largest error
};

// Measures bilinear lookups of the stored image at the points, as a runtime makes them.
MeasuredErrors measure_lookups(const TableModel& model, const Image2<float>& image,
                               const ReferencePoints& points);

// Measures the kernel itself at the points, at a quadrature level. No table that the kernel fills
// at this level can be expected to have a smaller error.
MeasuredErrors measure_kernel(const TableModel& model, int level, const ReferencePoints& points,
                              const BakeOptions& options);

// The exact values of a volume, one per channel, at texture coordinates in [0, 1]. Voxel i of an
// axis is at (i + 1/2) / size, whatever place the voxel samples.
using VolumeReference = std::function<std::vector<double>(const std::array<double, 3>& uvw)>;

// Another way of measuring errors, for volumes where errors as fractions of each channel's value
// range would say little. Empty members change nothing.
struct VolumeComparison {
    // Returns the errors at texture coordinates, given the values found and wanted there. The
    // number of errors is the same everywhere.
    std::function<std::vector<double>(const std::array<double, 3>& uvw,
                                      const std::vector<double>& found,
                                      const std::vector<double>& wanted)>
        errors;
    // Returns the standard error of each error, of a reference that draws random numbers. What they make of
    // the figures is taken off.
    std::function<std::vector<double>(const std::vector<double>& wanted)> noise = {};
    // Returns the texture coordinates nearest to `uvw` that a runtime may look up.
    std::function<std::array<double, 3>(const std::array<double, 3>& uvw)> lookup_place;
    std::string scale;  // what an error of 1 means
};

struct VolumeErrors {
    ErrorFigures figures;           // over all channels, or all errors of the comparison
    std::array<double, 3> worst{};  // texture coordinates of the largest error
    int points = 0;
};

// Measures trilinear lookups of the stored voxels at `count` points of the fixed set. Axes are
// repeated or clamped as level.repeats says. Along an axis of one voxel, the points lie at its
// centre. Voxels are evaluated one by one, so the volume is never held in memory. Where less than half
// of the voxels are filled, half of the points lie beside such voxels and weigh the less: the edges of
// sparse clouds are a hundredth of their box.
VolumeErrors measure_lookups(const Level& level, PixelType type, const VolumeReference& reference,
                             int count, const BakeOptions& options,
                             const VolumeComparison& comparison = {});

// Measures the voxels that the same set falls into, moved by comparison.lookup_place, at their centres.
VolumeErrors measure_voxels(const Level& level, PixelType type, const VolumeReference& reference,
                            int count, const BakeOptions& options,
                            const VolumeComparison& comparison = {});

// Returns the errors of values at texture coordinates: those of the comparison or, if it has none, shares
// of each channel's range, max - min. A channel that has one value everywhere is compared by absolute
// differences.
std::vector<double> errors_of(const Level& level, const VolumeComparison& comparison,
                              const std::array<double, 3>& uvw, const std::vector<double>& found,
                              const std::vector<double>& wanted);

// Returns the result of a lookup of the stored voxels, one value per channel.
std::vector<double> look_up(const Level& level, PixelType type, const std::array<double, 3>& uvw);

// Searches the errors of a table's lookups (error_search.h): measures bilinear lookups of the stored
// image against model.reference. If counts.exact is not 0, the kernel at the quadrature level is the
// estimate that is searched. `threads` may be any number.
FoundErrors search_table(const TableModel& model, int level, const Image2<float>& image,
                         const SearchCounts& counts, const BakeOptions& options);

// Searches the errors of trilinear lookups of the stored voxels. Axes are clamped or repeated as
// level.repeats says. `counts.per_row` is not used: each row has one point. If `estimate` is not
// empty and counts.exact is not 0, it is searched in place of the reference. Where the voxels let
// large errors expect is only looked at if there are at most 2^18 of them.
VolumeErrors search_volume(const Level& level, PixelType type, const VolumeReference& reference,
                           const VolumeReference& estimate, const SearchCounts& counts,
                           const BakeOptions& options, const VolumeComparison& comparison);

// The maximum and the root mean square of a series of errors, summed in the order given.
class ErrorStatistics {
  public:
    // `noise` is the standard error of the error. noise^2 is taken off its square, and 2 noise, which one in
    // twenty exceeds without any error, off its size. `weight` is that of its square. Returns whether it is
    // the largest so far.
    bool add(double error, double noise = 0, double weight = 1) {
        const double size = std::max(std::fabs(error) - 2 * noise, 0.0);
        const bool is_largest = size > max_ || std::isnan(size);
        if (is_largest) max_ = size;  // NaN stays: no bound accepts it
        const double square = weight * (error * error - noise * noise);
        sum_of_squares_ += square;
        if (noise > 0) uncertainty_ += square * square;
        ++count_;
        weights_ += weight;
        return is_largest;
    }
    // The root mean square is no less than what the noise lets one see.
    ErrorFigures figures() const {
        const double squares = std::max(sum_of_squares_, std::sqrt(uncertainty_));
        return {max_, count_ == 0 ? 0 : std::sqrt(squares / weights_)};
    }
    double max() const { return max_; }
    long count() const { return count_; }

  private:
    double max_ = 0;
    double sum_of_squares_ = 0;
    double uncertainty_ = 0;  // the square of that of the sum
    double weights_ = 0;
    long count_ = 0;
};

}  // namespace skybake
