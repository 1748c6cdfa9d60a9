#include "bakers/atmosphere/transmittance_field.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "bakers/atmosphere/optical_depth.h"
#include "bakers/atmosphere/transmittance_mapping.h"
#include "bakers/core/parallel.h"
#include "bakers/core/transcendental.h"

namespace skybake {

namespace {

// A cubic between two nodes is monotone while its slopes have the sign of the difference and at
// most three times its size (Fritsch & Carlson 1980).
double within_three_times(double slope, double difference) {
    if (slope * difference <= 0) return 0;
    return std::fabs(slope) > 3 * std::fabs(difference) ? 3 * difference : slope;
}

// Slope at a node between two differences: that of the parabola through three nodes.
double monotone_slope(double before, double after) {
    return within_three_times(within_three_times(0.5 * (before + after), before), after);
}

// The same at an end, from the two differences inwards.
double monotone_end_slope(double nearest, double next) {
    return within_three_times(1.5 * nearest - 0.5 * next, nearest);
}

}  // namespace

TransmittanceField::TransmittanceField(const Medium& medium, Size size, int threads)
    : shell_(shell_of(medium)), channels_(medium.channels), size_(size) {
    const auto row_length = static_cast<std::size_t>(row_size());
    values_.resize(row_length * static_cast<std::size_t>(size.rows));
    slopes_.resize(values_.size());
    parallel_for(size.rows, threads, [&](int y) {
        std::vector<double> s(static_cast<std::size_t>(size.columns));
        double altitude = 0;
        for (int x = 0; x < size.columns; ++x) {
            const TransmittanceRay ray =
                transmittance_ray(shell_, {static_cast<double>(x) / (size.columns - 1),
                                           static_cast<double>(y) / (size.rows - 1)});
            altitude = ray.altitude_km;
            s[static_cast<std::size_t>(x)] = ray.s_km;
        }
        std::vector<double> depth(s.size() * kMaxChannels);
        optical_depth_to_top(medium, altitude, s.data(), size.columns, depth.data());
        double* row = values_.data() + row_length * static_cast<std::size_t>(y);
        for (int c = 0; c < channels_; ++c) {
            double* channel = row + c * row_stride();
            for (int x = 0; x < row_stride(); ++x) {
                const int from = c * size.columns + std::min(x, size.columns - 1);
                channel[x] = exponential(-depth[static_cast<std::size_t>(from)]);
            }
        }
    });
    for (int y = 0; y < size.rows; ++y) {
        const double* row = values_.data() + row_length * static_cast<std::size_t>(y);
        const double* below = y > 0 ? row - row_length : row;
        const double* above = y + 1 < size.rows ? row + row_length : row;
        double* slope = slopes_.data() + row_length * static_cast<std::size_t>(y);
        if (y > 0 && y + 1 < size.rows) {
            for (std::size_t i = 0; i < row_length; ++i) {
                slope[i] = monotone_slope(row[i] - below[i], above[i] - row[i]);
            }
            continue;
        }
        // At the ground and at the top from the two differences inwards.
        const double* first = y == 0 ? row : below;
        const double* second = y == 0 ? above : row;
        const double* beyond = y == 0 ? above + row_length : below - row_length;
        for (std::size_t i = 0; i < row_length; ++i) {
            const double next = y == 0 ? beyond[i] - second[i] : first[i] - beyond[i];
            slope[i] = monotone_end_slope(second[i] - first[i], next);
        }
    }
}

TransmittanceField::Row TransmittanceField::row_at(double altitude_km) const {
    const double x_r =
        horizon_distance_km(shell_, altitude_km) / horizon_distance_km(shell_, shell_.thickness_km);
    const double position = x_r * (size_.rows - 1);
    const int y = std::min(static_cast<int>(position), size_.rows - 2);
    const double t = position - y;
    const double t2 = t * t;
    const double t3 = t2 * t;
    const auto offset = static_cast<std::size_t>(row_size()) * static_cast<std::size_t>(y);
    return {values_.data() + offset,
            slopes_.data() + offset,
            {2 * t3 - 3 * t2 + 1, 3 * t2 - 2 * t3, t3 - 2 * t2 + t, t3 - t2}};
}

}  // namespace skybake
