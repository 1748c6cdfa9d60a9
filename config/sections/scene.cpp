#include "config/sections/scene.h"

#include "config/fields/fields.h"
#include "config/sections/sections.h"

namespace skybake::config {
namespace {

const SceneField scene_table[] = {
    {"altitude", Kind::length_bounds, &Scene::altitude,
     "altitudes of the cameras, from the lowest to the highest", camera_altitude_range,
     Default{R"(["0 km", "3 km"])"}},
    {"sun_elevation", Kind::angle_bounds, &Scene::sun_elevation,
     "elevations of the sun at the cameras, from the lowest to the highest", elevation_range,
     Default{R"(["-90 deg", "90 deg"])"}, Hint{"-18 deg is the end of twilight on Earth"}},
    {"view_distance", Kind::length, &Scene::view_distance,
     "distance up to which the cameras see things on the ground", view_distance_range,
     Default{R"("64 km")"}, Role::usual},
};

}  // namespace

std::span<const SceneField> scene_fields() { return scene_table; }

}  // namespace skybake::config
