#include "config/assets/sky_view.h"

#include "config/assets/asset_fields.h"
#include "config/assets/asset_kind.h"
#include "config/fields/fields.h"

namespace skybake::config {
namespace {

using SkyViewField = Row<SkyViewBake>;

constexpr std::array sky_method_choices = {
    Choice{SkyMethod::solved, "solved", "all orders, each layer with its own phase function"},
    Choice{SkyMethod::strips, "strips",
           "the second order alone, lit by a sky of 8 strips (Ai et al. 2014)"},
};

constexpr std::string_view with_multiple[] = {"all", "multiple"};

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
         .documentation = "suns with a table each, stacked in one file, the first at v = 0"},
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
};

std::vector<Read> reads_of(const Parameters& parameters, const SkyViewBake&) {
    return reads_of_light(parameters, Roles::all());
}

}  // namespace

const AssetKind& asset_kind(Tag<SkyViewBake>) {
    static const auto rows = with_file_fields(sky_view_table, table_files);
    static const AssetKind kind = make_asset_kind<SkyViewBake>(
        {
            .name = "sky_view",
            .documentation = "the sky as a camera sees it, under given suns",
            .is_table = true,
            .needs_atmosphere = true,
            .use_of_light = UseOfLight::colors,
        },
        std::span<const SkyViewField>(rows), reads_of);
    return kind;
}

}  // namespace skybake::config
