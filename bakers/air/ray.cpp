#include "bakers/air/ray.h"

#include <cassert>
#include <cstddef>

namespace skybake {

std::vector<double> break_altitudes_km(const Medium& medium,
                                       const std::vector<double>& scale_heights) {
    std::vector<double> altitudes = kink_altitudes_km(medium);
    altitudes.push_back(0);
    altitudes.push_back(medium.thickness_km);
    for (const ExponentialLayer& layer : medium.exponential_layers) {
        for (const double count : scale_heights) {
            const double altitude = count * layer.scale_height_km;
            if (altitude < medium.thickness_km) altitudes.push_back(altitude);
        }
    }
    std::ranges::sort(altitudes);
    altitudes.erase(std::unique(altitudes.begin(), altitudes.end()), altitudes.end());
    return altitudes;
}

std::vector<RayBreak> ray_breaks(const Shell& shell, double altitude_km, double s_km,
                                 double length_km, const std::vector<double>& altitudes_km) {
    assert(std::ranges::is_sorted(altitudes_km));
    std::vector<RayBreak> breaks = {{0, -1}};
    const auto add = [&](double distance, int level) {
        if (distance > 0 && distance < length_km) breaks.push_back({distance, level});
    };
    for (std::size_t i = 0; i < altitudes_km.size(); ++i) {
        // The ray crosses where x (x + 2 s) = q; both roots without cancellation.
        const double gain = altitudes_km[i] - altitude_km;
        const double q = square_gain_km2(shell, altitude_km, gain);
        const double discriminant = s_km * s_km + q;
        if (discriminant < 0) continue;
        const double root = std::sqrt(discriminant);
        const int level = static_cast<int>(i);
        if (s_km >= 0) {
            if (q > 0) add(q / (root + s_km), level);
        } else {
            add(root - s_km, level);
            add(-q / (root - s_km), level);
        }
    }
    if (s_km < 0) add(-s_km, -1);
    breaks.push_back({length_km, -1});
    std::ranges::sort(
        breaks, [](const RayBreak& a, const RayBreak& b) { return a.distance_km < b.distance_km; });
    const auto same = [](const RayBreak& a, const RayBreak& b) {
        return a.distance_km == b.distance_km;
    };
    breaks.erase(std::unique(breaks.begin(), breaks.end(), same), breaks.end());
    return breaks;
}

}  // namespace skybake
