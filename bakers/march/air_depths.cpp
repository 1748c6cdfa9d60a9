#include "bakers/march/air_depths.h"

#include <algorithm>
#include <cmath>

#include "bakers/air/ray.h"
#include "bakers/field/interpolation.h"
#include "bakers/march/layer_march.h"

namespace skybake {
namespace {

constexpr int kDistances = 48;

// Returns the length of the whole ray, which ends at the ground or at the top of the atmosphere.
double whole_length_km(const Shell& shell, double altitude_km, double s_km) {
    if (s_km < -horizon_distance_km(shell, altitude_km)) {
        return distance_to_ground_km(shell, altitude_km, s_km);
    }
    return distance_to_top_km(shell, altitude_km, s_km);
}

// Writes the optical depths at ascending distances, by Simpson's rule between neighbouring
// distances.
void optical_depths(const Medium& air, double altitude_km, double mu,
                    const std::vector<double>& distances_km, float* out, std::size_t stride) {
    const Shell shell = shell_of(air);
    const double s = (shell.ground_radius_km + altitude_km) * mu;
    const auto extinction = [&](double distance) {
        const double altitude = altitude_along_km(shell, altitude_km, s, distance);
        return extinction_at(air, std::clamp(altitude, 0.0, shell.thickness_km));
    };
    Spectrum sum{};
    Spectrum before = extinction(0);
    double from = 0;
    for (const double to : distances_km) {
        const Spectrum middle = extinction(0.5 * (from + to));
        const Spectrum after = extinction(to);
        for (int c = 0; c < air.channels; ++c) {
            const auto i = static_cast<std::size_t>(c);
            sum[i] += (to - from) / 6 * (before[i] + 4 * middle[i] + after[i]);
            out[i] = static_cast<float>(sum[i]);
        }
        out += stride;
        before = after;
        from = to;
    }
}

}  // namespace

AirDepths::AirDepths(const Medium& air, double altitude_km, const Range& range)
    : range_(range), depths_(kDistances + 1, range.elevations, air.channels) {
    for (int row = 0; row < range.elevations; ++row) fill_row(air, altitude_km, row);
}

void AirDepths::fill_row(const Medium& air, double altitude_km, int row) {
    const Shell shell = shell_of(air);
    const double t = static_cast<double>(row) / (range_.elevations - 1);
    const double elevation =
        range_.lowest_degrees + t * (range_.highest_degrees - range_.lowest_degrees);
    const double mu = sine_of_degrees(elevation);
    const double length_km =
        whole_length_km(shell, altitude_km, (shell.ground_radius_km + altitude_km) * mu);
    std::vector<double> distances_km;
    for (int i = 0; i < kDistances; ++i) {
        const double x = static_cast<double>(i) / (kDistances - 1);
        distances_km.push_back(std::min(x * x * range_.reach_m / 1000, length_km));
    }
    optical_depths(air, altitude_km, mu, distances_km, depths_.texel(0, row),
                   static_cast<std::size_t>(air.channels));
    // The whole ray has the same number of steps, and short ones come first.
    std::vector<float> whole(static_cast<std::size_t>(air.channels * kDistances));
    for (int i = 0; i < kDistances; ++i) {
        const double x = (i + 1.0) / kDistances;
        distances_km[static_cast<std::size_t>(i)] = x * x * length_km;
    }
    optical_depths(air, altitude_km, mu, distances_km, data(whole),
                   static_cast<std::size_t>(air.channels));
    std::copy(whole.end() - air.channels, whole.end(), depths_.texel(kDistances, row));
}

AirDepths::Depths AirDepths::at(double height, double distance_m) const {
    // Row and column in the table, where texel i is at i.
    const double column =
        std::sqrt(std::clamp(distance_m / range_.reach_m, 0.0, 1.0)) * (kDistances - 1);
    const double v = (0.5 + height * (range_.elevations - 1)) / range_.elevations;
    Depths depths;
    bilinear(depths_, (column + 0.5) / (kDistances + 1), v, data(depths.near));
    bilinear(depths_, 1, v, data(depths.whole));
    return depths;
}

}  // namespace skybake
