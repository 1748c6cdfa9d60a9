#include "bakers/light/multiple_scattering_mapping.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bakers/light/sky_view_mapping.h"

namespace skybake {

using config::MultipleScatteringMapping;

double sun_cos_zenith_at(MultipleScatteringMapping mapping, double x) {
    const double centred = 2 * x - 1;
    return mapping == MultipleScatteringMapping::twilight ? centred * std::fabs(centred) : centred;
}

double sun_coordinate(MultipleScatteringMapping mapping, double sun_cos_zenith) {
    const double centred = mapping == MultipleScatteringMapping::twilight
                               ? std::copysign(std::sqrt(std::fabs(sun_cos_zenith)), sun_cos_zenith)
                               : sun_cos_zenith;
    return 0.5 + 0.5 * centred;
}

SunRange scene_sun_range(const config::Scene& scene, const Shell& shell) {
    constexpr double kPi = std::numbers::pi;
    const double psi = SkyViewCamera(shell, scene.altitude[1].kilometers()).dip() +
                       SkyViewCamera(shell, shell.thickness_km).dip();
    const double nearest = std::max(kPi / 2 - scene.sun_elevation[1].radians - psi, 0.0);
    const double farthest = std::min(kPi / 2 - scene.sun_elevation[0].radians + psi, kPi);
    // Rounding may bring a cosine a little beyond its bounds.
    return {std::max(cosine_of(farthest), -1.0), std::min(cosine_of(nearest), 1.0)};
}

SunColumns sun_columns(config::MultipleScatteringMapping mapping,
                       const std::optional<config::Scene>& scene, const Shell& shell) {
    SunColumns columns{mapping};
    if (scene) {
        const SunRange range = scene_sun_range(*scene, shell);
        columns.first = sun_coordinate(mapping, range.lowest);
        columns.last = sun_coordinate(mapping, range.highest);
    }
    return columns;
}

}  // namespace skybake
