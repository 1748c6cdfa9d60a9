#include "bakers/plan/cloud_views.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bakers/assets/cloud_light/cloud_layer.h"
#include "bakers/light/sky_ray.h"
#include "bakers/math/vectors.h"
#include "config/sweep/sobol.h"

namespace skybake {

CloudRange cloud_range(const config::Scene& scene, const config::Cloud& cloud) {
    CloudRange range;
    range.lowest_altitude_m = scene.altitude[0].meters;
    range.highest_altitude_m = scene.altitude[1].meters;
    range.base_m = cloud.base_altitude.meters;
    range.height_m = cloud.extent[2].meters;
    range.view_distance_m = scene.view_distance.meters;
    range.has_own_suns = !scene.suns.empty();
    const auto add = [&](double sun_deg) {
        if (sun_deg >= kLowestCloudSun_deg) range.suns_deg.push_back(sun_deg);
    };
    for (const config::Angle& sun : scene.suns) add(sun.radians * kDegreesPerRadian);
    if (range.has_own_suns) return range;
    const double lowest =
        std::max(scene.sun_elevation[0].radians * kDegreesPerRadian, kLowestCloudSun_deg);
    const double highest = scene.sun_elevation[1].radians * kDegreesPerRadian;
    for (const double sun_deg : {10.0, 30.0, 60.0}) {
        const double within = std::clamp(sun_deg, std::min(lowest, highest), highest);
        if (range.suns_deg.empty() || range.suns_deg.back() != within) add(within);
    }
    return range;
}

std::vector<CloudView> cloud_views(const CloudRange& range, int count, std::uint32_t first) {
    std::vector<CloudView> views;
    for (std::uint32_t i = first; i < first + static_cast<std::uint32_t>(count); ++i) {
        const auto share = [i](int dimension) { return config::sobol_coordinate(i, dimension); };
        const double altitude_m = range.lowest_altitude_m +
                                  share(1) * (range.highest_altitude_m - range.lowest_altitude_m);
        const double height = (altitude_m - range.base_m) / range.height_m;  // 0 to 1: within
        const bool looks_up = height <= 0 || (height < 1 && share(6) < 0.5);
        const double rise_m = (looks_up ? 1 - height : height) * range.height_m;
        const double lowest = std::asin(std::min(1.0, rise_m / range.view_distance_m));
        const double elevation = lowest + share(2) * (std::numbers::pi / 2 - lowest);
        CloudView view;
        view.sun = static_cast<std::size_t>(share(0) * static_cast<double>(range.suns_deg.size()));
        view.look = cloud_light::towards(looks_up ? elevation : -elevation,
                                         2 * std::numbers::pi * share(3));
        view.place = {share(4), share(5), std::clamp(height, 0.0, 1.0)};
        views.push_back(view);
    }
    return views;
}

}  // namespace skybake
