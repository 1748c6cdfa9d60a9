#include "config/assets/forward_scattering.h"

#include "config/assets/asset_fields.h"
#include "config/assets/asset_kind.h"
#include "config/assets/droplet_fields.h"
#include "config/fields/fields.h"

namespace skybake::config {
namespace {

using ForwardField = Row<ForwardScatteringBake>;

const std::array forward_scattering_table = {
    ForwardField{asset_field, {}},
    ForwardField{{.key = "size",
                  .kind = Kind::size,
                  .range = texel_range,
                  .fallback = "[128, 64]",
                  .documentation = "texels along the scattering angle and along the optical depth",
                  .exclusive_group = "size"},
                 &ForwardScatteringBake::size},
    ForwardField{max_error_field, &ForwardScatteringBake::max_error},
    ForwardField{
        {.key = "degree",
         .kind = Kind::integer,
         .range = harmonics_degree_range,
         .fallback = "3",
         .documentation = "degree of the harmonics of cloud_light that hold the other light"},
        &ForwardScatteringBake::degree},
    ForwardField{droplet_diameter_field, &ForwardScatteringBake::droplet_diameter},
    ForwardField{single_scattering_albedo_field, &ForwardScatteringBake::single_scattering_albedo},
};

std::vector<Read> reads_of(const Parameters&, const ForwardScatteringBake&) { return {}; }

}  // namespace

const AssetKind& asset_kind(Tag<ForwardScatteringBake>) {
    static const auto rows = with_file_fields(forward_scattering_table, table_files);
    static const AssetKind kind = make_asset_kind<ForwardScatteringBake>(
        {
            .name = "forward_scattering",
            .documentation = "sunlight that a cloud scatters on by small angles, of all orders",
            .is_table = true,
        },
        std::span<const ForwardField>(rows), reads_of);
    return kind;
}

}  // namespace skybake::config
