#include "config/assets/transmittance.h"

#include "config/assets/asset_fields.h"
#include "config/assets/asset_kind.h"
#include "config/fields/fields.h"

namespace skybake::config {
namespace {

using TransmittanceField = Row<TransmittanceBake>;

constexpr std::array transmittance_content_choices = {
    Choice{TransmittanceContent::transmittance, "transmittance",
           "the share of light that passes, in [0, 1]"},
    Choice{TransmittanceContent::optical_depth, "optical_depth",
           "-ln of the transmittance, which keeps its digits where the transmittance underflows"},
};

constexpr std::array transmittance_mapping_choices = {
    Choice{TransmittanceMapping::bruneton, "bruneton",
           "ratios of distances, with end points on texel centres"},
    Choice{TransmittanceMapping::ue, "ue",
           "the same ratios without the half-texel correction, as widely copied"},
};

const std::array transmittance_table = {
    TransmittanceField{asset_field, {}},
    TransmittanceField{{.key = "size",
                        .kind = Kind::size,
                        .range = texel_range,
                        .fallback = "[256, 64]",
                        .documentation = "texels along the zenith angle and along altitude",
                        .citation = bruneton_2008,
                        .exclusive_group = "size"},
                       &TransmittanceBake::size},
    TransmittanceField{max_error_field, &TransmittanceBake::max_error},
    TransmittanceField{{.key = "content",
                        .kind = Kind::choice,
                        .choices = transmittance_content_choices,
                        .fallback = R"("transmittance")",
                        .documentation = "what the texels hold"},
                       &TransmittanceBake::content},
    TransmittanceField{{.key = "mapping",
                        .kind = Kind::choice,
                        .choices = transmittance_mapping_choices,
                        .fallback = R"("bruneton")",
                        .documentation = "which angle and altitude a texel stands for",
                        .citation = bruneton_2008},
                       &TransmittanceBake::mapping},
};

std::vector<Read> reads_of(const Parameters& parameters, const TransmittanceBake&) {
    return reads_of_air(parameters, {Role::geometry, Role::extinction});
}

}  // namespace

const AssetKind& asset_kind(Tag<TransmittanceBake>) {
    static const auto rows = with_file_fields(transmittance_table, table_files);
    static const AssetKind kind = make_asset_kind<TransmittanceBake>(
        {
            .name = "transmittance",
            .documentation = "the share of light that arrives from the top of the atmosphere",
            .is_table = true,
            .needs_atmosphere = true,
            .use_of_light = UseOfLight::factors,
        },
        std::span<const TransmittanceField>(rows), reads_of);
    return kind;
}

}  // namespace skybake::config
