#include "bakers/air/optical_depth.h"

#include <cassert>
#include <cmath>
#include <cstddef>
#include <vector>

#include "bakers/air/ray.h"
#include "bakers/math/quadrature.h"

namespace skybake {
namespace {

// An optical depth that no transmittance in double can show.
constexpr double kNegligibleDepth = 1e-17;

// The altitudes of a path, by distance from its lowest point, which may be one of its ends. Each is
// a sum of terms that are not negative. By distance from the start of a falling path, altitudes near
// the ground would be differences of lengths of a thousand kilometres, wrong by 1e-8 of a scale
// height of 1 mm, and no adaptive rule would end.
struct PathAltitudes {
    double lowest_km = 0;
    double lowest_at_km = 0;  // distance of the lowest point from the path's start
    double r_km = 0;          // of the lowest point
    double s_km = 0;          // >= 0, away from the lowest point; 0 where the path passes it

    double operator()(double distance_km) const {
        const double away = std::fabs(distance_km);
        return lowest_km + gain_of_square_km(r_km, away * (away + 2 * s_km));
    }
};

PathAltitudes path_altitudes(const Shell& shell, double altitude_km, double s_km,
                             double distance_km) {
    const auto from = [&](double lowest_km, double at_km, double s) {
        return PathAltitudes{lowest_km, at_km, shell.ground_radius_km + lowest_km, s};
    };
    if (s_km >= 0) return from(altitude_km, 0, s_km);
    if (s_km + distance_km > 0) {
        return from(altitude_km - drop_to_nearest_km(shell, altitude_km, s_km), -s_km, 0);
    }
    return from(altitude_along_km(shell, altitude_km, s_km, distance_km), distance_km,
                -(s_km + distance_km));
}

}  // namespace

Spectrum reference_optical_depth_along(const Medium& medium, double altitude_km, double s_km,
                                       double distance_km, double relative) {
    assert(relative > 0);
    const Shell shell = shell_of(medium);
    const PathAltitudes altitudes = path_altitudes(shell, altitude_km, s_km, distance_km);
    const auto extinction = [&](double x) { return extinction_at(medium, altitudes(x)); };
    // Adaptive rules see nothing of a layer that all their nodes miss: begin with intervals of a
    // few scale heights.
    const std::vector<RayBreak> breaks = ray_breaks(shell, altitude_km, s_km, distance_km,
                                                    break_altitudes_km(medium, {2, 6, 14, 30}));
    Spectrum sum{};
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
        const Spectrum part = adaptive_integral<Spectrum>(
            extinction, breaks[i].distance_km - altitudes.lowest_at_km,
            breaks[i + 1].distance_km - altitudes.lowest_at_km, relative, kNegligibleDepth);
        sum += part;
    }
    return sum;
}

Spectrum reference_optical_depth_to_top(const Medium& medium, double altitude_km, double s_km,
                                        double relative) {
    const double distance = distance_to_top_km(shell_of(medium), altitude_km, s_km);
    return reference_optical_depth_along(medium, altitude_km, s_km, distance, relative);
}

}  // namespace skybake
