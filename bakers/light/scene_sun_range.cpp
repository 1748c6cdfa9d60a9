#include "bakers/light/scene_sun_range.h"

#include <algorithm>
#include <numbers>

#include "bakers/light/sky_view_mapping.h"

namespace skybake {

SunRange scene_sun_range(const config::Scene& scene, const Shell& shell) {
    constexpr double kPi = std::numbers::pi;
    const double psi = SkyViewCamera(shell, scene.altitude[1].kilometers()).dip() +
                       SkyViewCamera(shell, shell.thickness_km).dip();
    const double nearest = std::max(kPi / 2 - scene.sun_elevation[1].radians - psi, 0.0);
    const double farthest = std::min(kPi / 2 - scene.sun_elevation[0].radians + psi, kPi);
    // Rounding may bring a cosine a little beyond its bounds.
    return {std::max(cosine_of(farthest), -1.0), std::min(cosine_of(nearest), 1.0)};
}

}  // namespace skybake
