#include "config/assets/irradiance.h"

#include "config/assets/asset_fields.h"
#include "config/assets/asset_kind.h"
#include "config/fields/fields.h"

namespace skybake::config {
namespace {

constexpr Choice irradiance_content_choices[] = {
    {IrradianceContent::direct, "direct", "light of the sun alone"},
    {IrradianceContent::sky, "sky", "light of the sky alone"},
    {IrradianceContent::total, "total", "light of both"},
};

const Row<IrradianceBake> irradiance_table[] = {
    {"size", Kind::size, &IrradianceBake::size, "texels along the sun cosine and along altitude",
     texel_range, Default{"[64, 32]"}},
    {"content", Kind::choice, &IrradianceBake::content, "what lights the level surface",
     irradiance_content_choices, Default{R"("total")"}},
    {with(orders_field, When{"content", "sky"}), &IrradianceBake::orders},
    {layers_field, &IrradianceBake::layers},
    {"max_texel_error", Kind::fraction, &IrradianceBake::max_texel_error,
     "quadrature error of a texel, which sets the number of directions", texel_error_range,
     Default{R"("0.3 %")"}},
    {"mapping", Kind::choice, &IrradianceBake::mapping,
     "which sun angle and altitude a texel stands for", sun_mapping_choices,
     Default{R"("twilight")"}},
};

}  // namespace

AssetKind asset_kind(Tag<IrradianceBake>) {
    return make_asset_kind<IrradianceBake>(
        {.name = "irradiance",
         .documentation = "the light that falls on level surfaces",
         .is_table = true,
         .needs_atmosphere = true,
         .use_of_light = UseOfLight::colors},
        with_file_fields(irradiance_table, table_files), reads_of_all_light);
}

}  // namespace skybake::config
