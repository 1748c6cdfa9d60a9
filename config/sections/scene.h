// What a runtime will show: [scene].
#pragma once

#include <array>

#include "config/text/quantity.h"

namespace skybake::config {

// What a runtime will show: cameras and suns in ranges, so that tables need not hold more.
struct Scene {
    std::array<Length, 2> altitude;      // of cameras
    std::array<Angle, 2> sun_elevation;  // at the camera
    Length view_distance;
};

}  // namespace skybake::config
