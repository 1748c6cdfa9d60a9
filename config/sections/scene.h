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

// Choices that several assets of the sky share.
enum class MultipleScatteringMapping { hillaire, twilight };

// Which light: all of it; scattered once, in the air; or the rest, ground in sunlight included.
enum class SkyOrders { all, single, multiple };

// How light scattered twice or more is found: all orders solved for; or the second alone, from a
// sky of eight strips.
enum class SkyMethod { solved, strips };

}  // namespace skybake::config
