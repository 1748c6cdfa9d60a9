#include "bakers/air/transmittance_field.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/air/transmittance_field.cpp"
#include <hwy/foreach_target.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

#include "bakers/air/optical_depth.h"
#include "bakers/air/transmittance_mapping.h"
#include "bakers/math/channels-inl.h"
#include "bakers/math/parallel.h"
#include "bakers/math/transcendental.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::HWY_NAMESPACE {

// Reads the channels at columns[i] into values[c * count + i]. The next row is `size` numbers on.
void ReadColumns(const TransmittanceField::Row& row, int size, int channels, const double* columns,
                 int count, double* values) {
    for (int i = 0; i < count; ++i) {
        const int left = static_cast<int>(columns[i]);
        const Channels t(columns[i] - left);
        // Beyond the last channel there are numbers of the next column.
        const auto between = [&](const double* stored) {
            const double* at = stored + left * channels;
            const Channels before = Channels::load(at);
            return before + t * (Channels::load(at + channels) - before);
        };
        const Channels value =
            row.weights[0] * between(row.values) + row.weights[1] * between(row.values + size) +
            row.weights[2] * between(row.slopes) + row.weights[3] * between(row.slopes + size);
        for (int c = 0; c < channels; ++c) {
            values[c * count + i] = value[static_cast<std::size_t>(c)];
        }
    }
}

}  // namespace skybake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skybake {

HWY_EXPORT(ReadColumns);

namespace {

constexpr double kFlat = 32;

// A cubic between two nodes is monotone if its slopes have the sign of the difference and are at
// most three times as large (Fritsch & Carlson 1980).
double within_three_times(double slope, double difference) {
    if (slope * difference <= 0) return 0;
    return std::fabs(slope) > 3 * std::fabs(difference) ? 3 * difference : slope;
}

// Returns the slope at a node between two differences: that of the parabola through three nodes.
double monotone_slope(double before, double after) {
    return within_three_times(within_three_times(0.5 * (before + after), before), after);
}

// Returns the slope at an end, from the two nearest differences, the outer one first.
double monotone_end_slope(double nearest, double next) {
    return within_three_times(1.5 * nearest - 0.5 * next, nearest);
}

}  // namespace

bool is_flat_planet(const Shell& shell) {
    return horizon_distance_km(shell, shell.thickness_km) > kFlat * shell.thickness_km;
}

TransmittanceField::TransmittanceField(const Medium& medium,
                                       const std::vector<double>& altitudes_km, Size size,
                                       int threads)
    : shell_(shell_of(medium)),
      is_flat_(is_flat_planet(shell_)),
      channels_(medium.channels),
      columns_(size.columns) {
    assert(size.columns >= 8 && size.columns % 8 == 0 && altitudes_km.size() >= 2);
    assert(std::ranges::is_sorted(altitudes_km));
    const double top_distance = horizon_distance_km(shell_, shell_.thickness_km);
    const auto x_of = [&](double altitude_km) {
        return horizon_distance_km(shell_, altitude_km) / top_distance;
    };
    std::vector<double> x_of_row;
    for (std::size_t i = 0; i + 1 < altitudes_km.size(); ++i) {
        const double begin = x_of(altitudes_km[i]);
        const double end = x_of(altitudes_km[i + 1]);
        if (!(begin < end)) continue;  // closer than doubles can tell
        const int rows = std::max(size.least_rows, static_cast<int>((end - begin) * size.rows) + 1);
        blocks_.push_back({altitudes_km[i], begin, end, static_cast<int>(x_of_row.size()), rows});
        for (int y = 0; y < rows; ++y) {
            x_of_row.push_back(begin + (end - begin) * y / (rows - 1));
        }
        x_of_row.back() = end;
    }
    const auto row_length = static_cast<std::size_t>(row_size());
    values_.resize(row_length * x_of_row.size());
    slopes_.resize(values_.size());
    parallel_for(static_cast<int>(x_of_row.size()), threads, [&](int y) {
        const auto row = static_cast<std::size_t>(y);
        fill_row(medium, x_of_row[row], values_.data() + row_length * row);
    });
    for (const Block& block : blocks_) fill_slopes(block);
}

void TransmittanceField::fill_row(const Medium& medium, double x_r, double* row) const {
    std::vector<double> s(static_cast<std::size_t>(columns_));
    double altitude = 0;
    for (int x = 0; x < columns_; ++x) {
        const double share = static_cast<double>(x) / (columns_ - 1);
        const double x_mu = is_flat_ ? share * share * share * share : share;
        const TransmittanceRay ray = transmittance_ray(shell_, {x_mu, x_r});
        altitude = ray.altitude_km;
        s[static_cast<std::size_t>(x)] = ray.s_km;
    }
    std::vector<double> depth(s.size() * kMaxChannels);
    optical_depth_to_top(medium, altitude, s.data(), columns_, depth.data());
    for (int i = 0; i < row_size(); ++i) {
        const int from = i % channels_ * columns_ + std::min(i / channels_, columns_ - 1);
        row[i] = exponential(-depth[static_cast<std::size_t>(from)]);
    }
}

void TransmittanceField::fill_slopes(const Block& block) {
    const auto n = static_cast<std::size_t>(row_size());
    for (int y = 0; y < block.rows; ++y) {
        const auto offset = n * static_cast<std::size_t>(block.first_row + y);
        const double* row = values_.data() + offset;
        double* slope = slopes_.data() + offset;
        for (std::size_t i = 0; i < n; ++i) {
            // Only rows of this block are used: at its ends, the two nearest differences.
            if (y == 0) {
                slope[i] = monotone_end_slope(row[i + n] - row[i], row[i + 2 * n] - row[i + n]);
            } else if (y + 1 == block.rows) {
                slope[i] = monotone_end_slope(row[i] - *(row + i - n),
                                              *(row + i - n) - *(row + i - 2 * n));
            } else {
                slope[i] = monotone_slope(row[i] - *(row + i - n), row[i + n] - row[i]);
            }
        }
    }
}

TransmittanceField::Row TransmittanceField::row_at(double altitude_km) const {
    const auto above = std::ranges::upper_bound(blocks_, altitude_km, {}, &Block::bottom_km);
    const Block& block = above == blocks_.begin() ? blocks_.front() : *(above - 1);
    const double x_r =
        horizon_distance_km(shell_, altitude_km) / horizon_distance_km(shell_, shell_.thickness_km);
    // The position leaves the block at its ends only by rounding.
    const double share =
        std::clamp((x_r - block.x_begin) / (block.x_end - block.x_begin), 0.0, 1.0);
    const double position = share * (block.rows - 1);
    const int y = std::min(static_cast<int>(position), block.rows - 2);
    const double t = position - y;
    const double t2 = t * t;
    const double t3 = t2 * t;
    const auto offset =
        static_cast<std::size_t>(row_size()) * static_cast<std::size_t>(block.first_row + y);
    return {values_.data() + offset,
            slopes_.data() + offset,
            {2 * t3 - 3 * t2 + 1, 3 * t2 - 2 * t3, t3 - 2 * t2 + t, t3 - t2}};
}

void TransmittanceField::read(double altitude_km, const double* s_km, int count,
                              double* values) const {
    const Row row = row_at(altitude_km);
    const double nearest_km = shell_.thickness_km - altitude_km;
    const double farthest_km =
        horizon_distance_km(shell_, altitude_km) + horizon_distance_km(shell_, shell_.thickness_km);
    // At the top all ways to a sun above the horizontal are 0.
    const double columns_per_km = (columns_ - 1) / (farthest_km - nearest_km);
    const auto column_of = [&](double way_km) {
        if (!is_flat_) return way_km * columns_per_km;
        const double x_mu = std::max(way_km, 0.0) / (farthest_km - nearest_km);
        return (columns_ - 1) * std::sqrt(std::sqrt(x_mu));
    };
    std::vector<double> columns(static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < columns.size(); ++i) {
        const double way_km = distance_to_top_km(shell_, altitude_km, s_km[i]) - nearest_km;
        columns[i] = std::clamp(column_of(way_km), 0.0, columns_ - 1.0);
    }
    HWY_DYNAMIC_DISPATCH(ReadColumns)
    (row, row_size(), channels_, columns.data(), count, values);
}

}  // namespace skybake
#endif  // HWY_ONCE
