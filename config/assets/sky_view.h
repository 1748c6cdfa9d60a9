// This header declares the asset "sky_view": the sky that a camera sees, for each of the given
// elevations of the sun.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "config/sections/files.h"
#include "config/sections/scene.h"
#include "config/text/quantity.h"

namespace skybake::config {

struct SkyViewBake : LightFiles {
    std::array<int, 2> size{};  // texels along azimuth and along elevation, for one sun
    Length altitude;            // of the camera, which may be in space
    std::vector<Angle> sun_elevations;
    SkyOrders orders = SkyOrders::all;
    std::vector<std::string> layers;  // with orders = single: the layers that scatter; empty: all
    SkyMethod sky = SkyMethod::solved;
};

}  // namespace skybake::config
