// The field tables of the scene and of the sky as cameras see it; field_tables.cpp says how such
// tables work. The aerial perspective is a volume, and stands in volume_field_tables.cpp.
#include <numbers>

#include "config/assets/shared_fields.h"
#include "config/assets/sky_fields.h"
#include "config/fields/fields.h"
#include "config/fields/shared_ranges.h"

namespace skybake::config {
namespace {

constexpr std::array irradiance_content_choices = {
    Choice{"direct", "light of the sun alone"},
    Choice{"sky", "light of the sky alone"},
    Choice{"total", "light of both"},
};
constexpr std::array sun_mapping_choices = {
    Choice{"hillaire", "linear in sun cosine and altitude, with end points on texel centres"},
    Choice{"twilight", "more texels near sunrise and sunset"},
};

constexpr std::array sky_method_choices = {
    Choice{"solved", "all orders, each layer with its own phase function"},
    Choice{"strips", "the second order alone, lit by a sky of 8 strips (Ai et al. 2014)"},
};

constexpr std::string_view with_multiple[] = {"all", "multiple"};
constexpr std::string_view sky[] = {"sky"};

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
                .documentation = "distance up to which the cameras see things on the ground"},
               &Scene::view_distance},
};

const std::array sky_view_table = {
    SkyViewField{asset_field, {}},
    SkyViewField{{.key = "size",
                  .kind = Kind::size,
                  .range = texel_range,
                  .fallback = "[192, 108]",
                  .documentation = "texels along azimuth and along elevation, for one sun",
                  .citation = hillaire_2020},
                 &SkyViewBake::size},
    SkyViewField{camera_altitude_field, &SkyViewBake::altitude},
    SkyViewField{
        {.key = "sun_elevations",
         .kind = Kind::angles,
         .range = elevation_range,
         .required = true,
         .documentation = "suns with a table each, stacked in one file, the first at v = 0",
         .hint = "-90 deg to 90 deg"},
        &SkyViewBake::sun_elevations},
    SkyViewField{orders_field, &SkyViewBake::orders},
    SkyViewField{layers_field, &SkyViewBake::layers},
    SkyViewField{{.key = "sky",
                  .kind = Kind::choice,
                  .choices = sky_method_choices,
                  .fallback = R"("solved")",
                  .documentation = "how light scattered more than once is found",
                  .selector = "orders",
                  .selected_by = with_multiple},
                 &SkyViewBake::sky},
    SkyViewField{table_pixel_type_field, &SkyViewBake::pixel_type},
    SkyViewField{compression_field, &SkyViewBake::compression},
};

constexpr Field orders_of_sky() {
    Field field = orders_field;
    field.selector = "content";
    field.selected_by = sky;
    return field;
}

const std::array irradiance_table = {
    IrradianceField{asset_field, {}},
    IrradianceField{{.key = "size",
                     .kind = Kind::size,
                     .range = texel_range,
                     .fallback = "[64, 32]",
                     .documentation = "texels along the sun cosine and along altitude"},
                    &IrradianceBake::size},
    IrradianceField{{.key = "content",
                     .kind = Kind::choice,
                     .choices = irradiance_content_choices,
                     .fallback = R"("total")",
                     .documentation = "what lights the level surface"},
                    &IrradianceBake::content},
    IrradianceField{orders_of_sky(), &IrradianceBake::orders},
    IrradianceField{layers_field, &IrradianceBake::layers},
    IrradianceField{
        {.key = "max_texel_error",
         .kind = Kind::fraction,
         .range = texel_error_range,
         .fallback = R"("0.2 %")",
         .documentation = "quadrature error of a texel, which sets the number of directions"},
        &IrradianceBake::max_texel_error},
    IrradianceField{{.key = "mapping",
                     .kind = Kind::choice,
                     .choices = sun_mapping_choices,
                     .fallback = R"("twilight")",
                     .documentation = "which sun angle and altitude a texel stands for"},
                    &IrradianceBake::mapping},
    IrradianceField{table_pixel_type_field, &IrradianceBake::pixel_type},
    IrradianceField{compression_field, &IrradianceBake::compression},
};

}  // namespace

std::span<const SceneField> scene_fields() { return scene_table; }

std::span<const SkyViewField> sky_view_fields() { return sky_view_table; }

std::span<const IrradianceField> irradiance_fields() { return irradiance_table; }

}  // namespace skybake::config
