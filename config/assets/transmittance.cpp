#include "config/assets/transmittance.h"

#include "config/assets/asset_fields.h"
#include "config/assets/asset_kind.h"
#include "config/fields/fields.h"

namespace skybake::config {
namespace {

constexpr Choice transmittance_content_choices[] = {
    {TransmittanceContent::transmittance, "transmittance",
     "the share of light that passes, in [0, 1]"},
    {TransmittanceContent::optical_depth, "optical_depth",
     "-ln of the transmittance, which keeps its digits where the transmittance underflows"},
};

constexpr Choice transmittance_mapping_choices[] = {
    {TransmittanceMapping::bruneton, "bruneton",
     "ratios of distances, with end points on texel centres"},
    {TransmittanceMapping::ue, "ue",
     "the same ratios without the half-texel correction, as widely copied"},
};

const Row<TransmittanceBake> transmittance_table[] = {
    {"size", Kind::size, &TransmittanceBake::size,
     "texels along the zenith angle and along altitude", texel_range, Default{"[256, 64]"},
     Exclusive{"size"}, Cited{bruneton_2008}},
    {max_error_field, &TransmittanceBake::max_error},
    {"content", Kind::choice, &TransmittanceBake::content, "what the texels hold",
     transmittance_content_choices, Default{R"("transmittance")"}},
    {"mapping", Kind::choice, &TransmittanceBake::mapping,
     "which angle and altitude a texel stands for", transmittance_mapping_choices,
     Default{R"("bruneton")"}, Cited{bruneton_2008}},
};

std::vector<Read> reads_of(const Parameters& parameters, const TransmittanceBake&) {
    return reads_of_air(parameters, {Role::geometry, Role::extinction});
}

}  // namespace

AssetKind asset_kind(Tag<TransmittanceBake>) {
    return make_asset_kind<TransmittanceBake>(
        {.name = "transmittance",
         .documentation = "the share of light that arrives from the top of the atmosphere",
         .is_table = true,
         .needs_atmosphere = true,
         .use_of_light = UseOfLight::factors},
        with_file_fields(transmittance_table, table_files), reads_of);
}

}  // namespace skybake::config
