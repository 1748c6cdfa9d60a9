// This header declares [scene], which says what a runtime will show. It also holds choices that
// several assets of the sky share.
#pragma once

#include <array>

#include "config/text/quantity.h"

namespace skybake::config {

// A scene gives the ranges of cameras and suns that a runtime will show, so that tables need not
// hold more.
struct Scene {
    std::array<Length, 2> altitude;      // of cameras
    std::array<Angle, 2> sun_elevation;  // at the camera
    Length view_distance;
};

// The choices below are shared by several assets of the sky.
enum class MultipleScatteringMapping { hillaire, twilight };

// This says which light is meant: all of it, the light that the air scatters once, or the rest. The
// rest includes the light that the sunlit ground reflects.
enum class SkyOrders { all, single, multiple };

// This says how light scattered twice or more is found. It is either solved for all orders, or only
// the second order is computed, from a sky of eight strips.
enum class SkyMethod { solved, strips };

}  // namespace skybake::config
