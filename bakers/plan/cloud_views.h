// The views of a cloud's layer, in which ways to draw it are compared with paths of light.
//
// As the views of the sky (scene_views.h), suns, cameras and directions are points of Sobol's sequence:
// cameras even in altitude and over the tile, views even in azimuth and in elevation, as far as the layer
// is crossed within the view distance. The layer is flat.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/ext/vector_double3.hpp>
#include <vector>

#include "config/sections/cloud.h"
#include "config/sections/scene.h"

namespace skybake {

// The suns and cameras of a scene, and the layer that they see.
struct CloudRange {
    double lowest_altitude_m = 0;
    double highest_altitude_m = 0;
    double base_m = 0;
    double height_m = 0;
    double view_distance_m = 0;
    std::vector<double> suns_deg;  // above the horizon, at azimuth 0; may be empty
    bool has_own_suns = false;     // the scene states them
};

// Returns the scene's suns above kLowestCloudSun_deg, or, of a scene that states none, up to three of its
// range: the share of clouds that is lit and how deeply depends on where the sun is.
inline constexpr double kLowestCloudSun_deg = 2;
CloudRange cloud_range(const config::Scene& scene, const config::Cloud& cloud);

struct CloudView {
    std::size_t sun = 0;  // its number in suns_deg
    glm::dvec3 place{};   // where the ray meets the layer or begins within, in shares of the tile
    glm::dvec3 look{};    // a unit vector, z up
};

// Returns views number `first` and following. All of them cross the layer.
std::vector<CloudView> cloud_views(const CloudRange& range, int count, std::uint32_t first);

}  // namespace skybake
