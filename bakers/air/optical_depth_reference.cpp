#include "bakers/air/optical_depth.h"

#include <cassert>
#include <cstddef>
#include <vector>

#include "bakers/air/ray.h"
#include "bakers/math/quadrature.h"

namespace skybake {

namespace {

// An optical depth that no transmittance in double can show.
constexpr double kNegligibleDepth = 1e-17;

}  // namespace

Spectrum reference_optical_depth_along(const Medium& medium, double altitude_km, double s_km,
                                       double distance_km, double relative) {
    assert(relative > 0);
    const Shell shell = shell_of(medium);
    const auto extinction = [&](double x) {
        return extinction_at(medium, altitude_along_km(shell, altitude_km, s_km, x));
    };
    // Adaptive rules see nothing of a layer that all their nodes miss: begin with intervals of a
    // few scale heights.
    const std::vector<RayBreak> breaks = ray_breaks(shell, altitude_km, s_km, distance_km,
                                                    break_altitudes_km(medium, {2, 6, 14, 30}));
    Spectrum sum{};
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
        const Spectrum part =
            adaptive_integral<Spectrum>(extinction, breaks[i].distance_km,
                                        breaks[i + 1].distance_km, relative, kNegligibleDepth);
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
