#include "config/sections/scene.h"

#include "config/fields/fields.h"
#include "config/sections/sections.h"

namespace skybake::config {
namespace {

const std::array scene_table = {
    SceneField{{.key = "altitude",
                .kind = Kind::length_bounds,
                .range = camera_altitude_range,
                .fallback = R"(["0 km", "3 km"])",
                .documentation = "altitudes of the cameras, from the lowest to the highest"},
               &Scene::altitude},
    SceneField{
        {.key = "sun_elevation",
         .kind = Kind::angle_bounds,
         .range = elevation_range,
         .fallback = R"(["-90 deg", "90 deg"])",
         .documentation = "elevations of the sun at the cameras, from the lowest to the highest",
         .hint = "-18 deg is the end of twilight on Earth"},
        &Scene::sun_elevation},
    SceneField{{.key = "view_distance",
                .kind = Kind::length,
                .range = view_distance_range,
                .fallback = R"("64 km")",
                .documentation = "distance up to which the cameras see things on the ground",
                .role = Role::usual},
               &Scene::view_distance},
};

}  // namespace

std::span<const SceneField> scene_fields() { return scene_table; }

}  // namespace skybake::config
