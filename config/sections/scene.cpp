#include "config/sections/scene.h"

#include "config/fields/fields.h"
#include "config/sections/sections.h"

namespace skybake::config {
namespace {

constexpr Choice sky_by_choices[] = {
    {SkyBy::march, "march", "a loop along each ray, with tables of transmittance and of light"},
    {SkyBy::fetch, "fetch", "a lookup of a table of all rays, as in Bruneton 2017"},
    {SkyBy::picture, "picture", "a picture of the sky for each sun, seen from one altitude"},
};

constexpr Choice draws_choices[] = {
    {Draws::sky, "sky", "the clear sky of [atmosphere]"},
    {Draws::distance, "distance", "the air between the camera and things"},
    {Draws::ground_light, "ground_light", "the light of sun and sky on level ground"},
    {Draws::surroundings, "surroundings", "image-based light: sky and ground in all directions"},
    {Draws::clouds, "clouds", "each of [clouds] in sunlight"},
};

const Row<Scene> scene_table[] = {
    {"altitude", Kind::length_bounds, &Scene::altitude,
     "altitudes of the cameras, from the lowest to the highest", camera_altitude_range,
     Default{R"(["0 km", "3 km"])"}},
    {"sun_elevation", Kind::angle_bounds, &Scene::sun_elevation,
     "elevations of the sun at the cameras, from the lowest to the highest", elevation_range,
     Default{R"(["-90 deg", "90 deg"])"}, Hint{"-18 deg is the end of twilight on Earth"}},
    {"view_distance", Kind::length, &Scene::view_distance,
     "distance up to which the cameras see things on the ground", view_distance_range,
     Default{R"("64 km")"}, Role::usual},
    {"draws", Kind::choice_list, &Scene::draws, "what `skybake plan` plans of what the recipe has",
     draws_choices, Default{R"(["sky", "clouds"])"}, Role::usual},
    {"sky_by", Kind::choice_list, &Scene::sky_by,
     "how the runtime can draw the sky, for `skybake plan`", sky_by_choices,
     Default{R"(["march", "fetch", "picture"])"}, Role::usual},
    {"suns", Kind::angles, &Scene::suns,
     "elevations of the sun that the runtime shows, for `skybake plan`; without them any in "
     "`sun_elevation`",
     elevation_range, Role::usual},
    {"max_sky_error", Kind::fraction, &Scene::max_sky_error,
     "largest ninth decile of the sky's error that `skybake plan` may choose", lookup_error_range,
     Role::usual},
    {"max_cloud_error", Kind::fraction, &Scene::max_cloud_error,
     "largest RMS error of a cloud's picture, as a share of white, that `skybake plan` may choose",
     lookup_error_range, Role::usual},
    {"max_size_mib", Kind::number, &Scene::max_size_mib,
     "most MiB of textures that `skybake plan` may choose for each", Range{0, 1 << 20, true},
     Role::usual},
    {"max_fetches", Kind::number, &Scene::max_fetches,
     "most texture fetches per pixel that `skybake plan` may choose", Range{1, 1e6}, Role::usual},
};

}  // namespace

std::span<const Row<Scene>> scene_fields() { return scene_table; }

}  // namespace skybake::config
