// This header declares the asset "environment": an image of the sky, of clouds and of the ground
// around a camera, which renderers use as an environment map.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "config/sections/files.h"
#include "config/sections/scene.h"
#include "config/text/quantity.h"

namespace skybake::config {

// The direction that a texel shows. A cube is a strip of six faces below each other.
enum class EnvironmentMapping { longitude_latitude, cube, octahedral, equal_area };

// Whether texels hold the light of the sun's disc.
enum class SunInMap { none, disc };

// The content of the levels of detail beyond the first.
enum class LevelContent { mean, ggx };

struct EnvironmentBake : LightFiles {
    EnvironmentMapping mapping = EnvironmentMapping::longitude_latitude;
    std::array<int, 2> size{};  // of the image
    Length altitude;            // of the camera, which may be in space
    Angle sun_elevation;
    Angle sun_azimuth;  // to the right of straight ahead
    SkyOrders orders = SkyOrders::all;
    std::vector<std::string> layers;  // with orders = single: the layers that scatter; empty: all
    // NAMEs of [bake.NAME] with asset = "cloud_volume", of a layer each; empty: a clear sky.
    std::vector<std::string> clouds;
    Length camera_x;  // of the camera, from the corner of the clouds' tiles
    Length camera_y;
    int samples = 2;  // rays through the clouds along each edge of a texel
    SunInMap sun = SunInMap::none;
    LevelContent level_content = LevelContent::mean;
    bool lights = false;  // writes NAME.json
    // One per channel of light, of all packets; it multiplies all light. Empty: 1.
    std::vector<double> solar_irradiance;

    bool has_clouds() const { return !clouds.empty(); }
};

// Whether azimuths count from the sun, so that a lookup needs no other direction: the sun is straight
// ahead, and nothing but the sky stands there.
inline bool looks_to_the_sun(const EnvironmentBake& bake) {
    return bake.mapping == EnvironmentMapping::longitude_latitude && !bake.has_clouds() &&
           bake.sun_azimuth.radians == 0;
}

}  // namespace skybake::config
