// The views of a scene, in which ways to draw its sky are compared with paths of light.
//
// Suns, cameras and directions are points of Sobol's sequence: suns even in elevation, cameras even in
// altitude, views even in azimuth and in the angle above the horizon. So a ninth decile is that of the
// pictures a scene shows, and another part of the sequence has other views of the same scene.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "bakers/air/ray.h"
#include "bakers/assets/sky/sky_samples.h"
#include "config/sections/scene.h"

namespace skybake {

// The suns and cameras of a scene, cut down to those that see a sky.
struct SceneRange {
    double lowest_altitude_km = 0;
    double highest_altitude_km = 0;  // within the air
    double lowest_sun_deg = 0;
    double highest_sun_deg = 0;
    std::vector<double> suns_deg;  // the only suns; empty: any within the bounds
};

// Under a lower sun the sky of Earth is a thousandth as bright as at sunset.
inline constexpr double kLowestSun_deg = -6;

// Returns the range of a recipe's scene, or of a scene that says nothing. Suns below kLowestSun_deg
// count only where the scene has no others.
SceneRange range_of(const config::Scene& scene, const Shell& shell);

// Returns views number `first` and following, all of the sky above the horizon.
std::vector<SkySample> scene_views(const SceneRange& range, const Shell& shell, int count,
                                   std::uint32_t first);

}  // namespace skybake
