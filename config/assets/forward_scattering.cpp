#include "config/assets/forward_scattering.h"

#include "config/assets/asset_fields.h"
#include "config/assets/asset_kind.h"
#include "config/fields/fields.h"
#include "config/sections/sections.h"

namespace skybake::config {
namespace {

const Row<ForwardScatteringBake> forward_scattering_table[] = {
    {"size", Kind::size, &ForwardScatteringBake::size,
     "texels along the scattering angle and along the optical depth", texel_range,
     Default{"[128, 64]"}, Exclusive{"size"}},
    {max_error_field, &ForwardScatteringBake::max_error},
    {"degree", Kind::integer, &ForwardScatteringBake::degree,
     "degree of the harmonics of cloud_light that hold the other light", harmonics_degree_range,
     Default{"3"}},
    {"particles", Kind::choice, &ForwardScatteringBake::particles, "what the cloud consists of",
     cloud_particles_choices, Default{R"("droplets")"}},
    {with(droplet_diameter_field, When{"particles", "droplets"}),
     &ForwardScatteringBake::droplet_diameter},
    {single_scattering_albedo_field, &ForwardScatteringBake::single_scattering_albedo},
};

}  // namespace

AssetKind asset_kind(Tag<ForwardScatteringBake>) {
    return make_asset_kind<ForwardScatteringBake>(
        {.name = "forward_scattering",
         .documentation = "sunlight that a cloud scatters on by small angles, of all orders",
         .is_table = true},
        with_file_fields(forward_scattering_table, table_files), nullptr);
}

}  // namespace skybake::config
