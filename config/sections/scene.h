// This header declares [scene], which says what a runtime will show and how it may do that. It also
// holds choices that several assets of the sky share.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "config/text/quantity.h"

namespace skybake::config {

// How a runtime draws the sky: by a loop along each ray, by one lookup of a table of all rays, or from
// a picture of the whole sky for each sun.
enum class SkyBy { march, fetch, picture };

// The parts of the recipe that a scene draws: the sky, the air between the camera and things, the light
// that falls on the ground, images that light and are mirrored, and clouds.
enum class Draws { sky, distance, ground_light, surroundings, clouds };

// A scene gives the ranges of cameras and suns that a runtime will show, so that tables need not
// hold more. The other members are for `skybake plan`.
struct Scene {
    std::array<Length, 2> altitude;      // of cameras
    std::array<Angle, 2> sun_elevation;  // at the camera
    Length view_distance;
    std::vector<Draws> draws;               // sky and clouds, unless it says so
    std::vector<SkyBy> sky_by;              // empty: any
    std::vector<Angle> suns;                // the only ones; empty: any in sun_elevation
    std::optional<double> max_sky_error;    // ninth decile, relative
    std::optional<double> max_cloud_error;  // RMS of the picture, of white
    std::optional<double> max_size_mib;     // of the textures
    std::optional<double> max_fetches;      // of a pixel
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
