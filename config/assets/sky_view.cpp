#include "config/assets/sky_view.h"

#include "config/assets/asset_fields.h"
#include "config/assets/asset_kind.h"
#include "config/fields/fields.h"

namespace skybake::config {
namespace {

constexpr Choice sky_method_choices[] = {
    {SkyMethod::solved, "solved", "all orders, each layer with its own phase function"},
    {SkyMethod::strips, "strips",
     "the second order alone, lit by a sky of 8 strips (Ai et al. 2014)"},
};

const Row<SkyViewBake> sky_view_table[] = {
    {"size", Kind::size, &SkyViewBake::size,
     "texels along azimuth and along elevation, for one sun", texel_range, Default{"[192, 108]"},
     Cited{hillaire_2020}},
    {camera_altitude_field, &SkyViewBake::altitude},
    {"sun_elevations", Kind::angles, &SkyViewBake::sun_elevations,
     "suns with a table each, stacked in one file, the first at v = 0", elevation_range,
     KeyFlag::required},
    {orders_field, &SkyViewBake::orders},
    {layers_field, &SkyViewBake::layers},
    {"sky", Kind::choice, &SkyViewBake::sky, "how light scattered more than once is found",
     sky_method_choices, Default{R"("solved")"}, When{"orders", {"all", "multiple"}}},
};

}  // namespace

AssetKind asset_kind(Tag<SkyViewBake>) {
    return make_asset_kind<SkyViewBake>(
        {.name = "sky_view",
         .documentation = "the sky as a camera sees it, under given suns",
         .is_table = true,
         .needs_atmosphere = true,
         .use_of_light = UseOfLight::colors},
        with_file_fields(sky_view_table, table_files), reads_of_all_light);
}

}  // namespace skybake::config
