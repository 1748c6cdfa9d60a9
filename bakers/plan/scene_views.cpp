#include "bakers/plan/scene_views.h"

#include <algorithm>

#include "bakers/light/sky_view_mapping.h"
#include "config/sweep/sobol.h"

namespace skybake {

namespace {

// Cameras at the top itself see no air above them.
constexpr double kHighestShare = 0.99;

double between(double low, double high, double share) { return low + share * (high - low); }

}  // namespace

SceneRange range_of(const config::Scene& scene, const Shell& shell) {
    SceneRange range;
    const double highest_km = kHighestShare * shell.thickness_km;
    range.lowest_altitude_km = std::min(scene.altitude[0].kilometers(), highest_km);
    range.highest_altitude_km = std::min(scene.altitude[1].kilometers(), highest_km);
    for (const config::Angle& sun : scene.suns) {
        range.suns_deg.push_back(sun.radians * kDegreesPerRadian);
    }
    range.lowest_sun_deg = scene.sun_elevation[0].radians * kDegreesPerRadian;
    range.highest_sun_deg = scene.sun_elevation[1].radians * kDegreesPerRadian;
    if (range.highest_sun_deg > kLowestSun_deg) {
        range.lowest_sun_deg = std::max(range.lowest_sun_deg, kLowestSun_deg);
    }
    return range;
}

std::vector<SkySample> scene_views(const SceneRange& range, const Shell& shell, int count,
                                   std::uint32_t first) {
    std::vector<SkySample> views;
    for (std::uint32_t i = first; i < first + static_cast<std::uint32_t>(count); ++i) {
        const auto share = [i](int dimension) { return config::sobol_coordinate(i, dimension); };
        const double sun_deg = range.suns_deg.empty()
                                   ? between(range.lowest_sun_deg, range.highest_sun_deg, share(0))
                                   : range.suns_deg[static_cast<std::size_t>(
                                         share(0) * static_cast<double>(range.suns_deg.size()))];
        const double altitude_km =
            between(range.lowest_altitude_km, range.highest_altitude_km, share(1));
        const SkyViewCamera camera(shell, altitude_km);
        views.push_back(sky_sample(shell, altitude_km, sun_deg,
                                   share(2) * camera.range_above() * kDegreesPerRadian,
                                   180 * share(3)));
    }
    return views;
}

}  // namespace skybake
