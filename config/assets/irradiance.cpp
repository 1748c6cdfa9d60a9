#include "config/assets/irradiance.h"

#include "config/assets/asset_fields.h"
#include "config/assets/asset_kind.h"
#include "config/fields/fields.h"

namespace skybake::config {
namespace {

using IrradianceField = Row<IrradianceBake>;

constexpr std::array irradiance_content_choices = {
    Choice{IrradianceContent::direct, "direct", "light of the sun alone"},
    Choice{IrradianceContent::sky, "sky", "light of the sky alone"},
    Choice{IrradianceContent::total, "total", "light of both"},
};

constexpr std::array sun_mapping_choices = {
    Choice{MultipleScatteringMapping::hillaire, "hillaire",
           "linear in sun cosine and altitude, with end points on texel centres"},
    Choice{MultipleScatteringMapping::twilight, "twilight", "more texels near sunrise and sunset"},
};

constexpr std::string_view sky[] = {"sky"};

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
};

std::vector<Read> reads_of(const Parameters& parameters, const IrradianceBake&) {
    return reads_of_light(parameters, Roles::all());
}

}  // namespace

const AssetKind& asset_kind(Tag<IrradianceBake>) {
    static const auto rows = with_file_fields(irradiance_table, table_files);
    static const AssetKind kind = make_asset_kind<IrradianceBake>(
        {
            .name = "irradiance",
            .documentation = "the light that falls on level surfaces",
            .is_table = true,
            .needs_atmosphere = true,
            .use_of_light = UseOfLight::colors,
        },
        std::span<const IrradianceField>(rows), reads_of);
    return kind;
}

}  // namespace skybake::config
