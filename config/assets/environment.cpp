#include "config/assets/environment.h"

#include "config/assets/asset_fields.h"
#include "config/assets/asset_kind.h"
#include "config/fields/fields.h"

namespace skybake::config {
namespace {

using EnvironmentField = Row<EnvironmentBake>;

const std::array environment_table = {
    EnvironmentField{asset_field, {}},
    EnvironmentField{{.key = "size",
                      .kind = Kind::size,
                      .range = texel_range,
                      .fallback = "[1024, 512]",
                      .documentation = "texels around, and from the zenith to straight down"},
                     &EnvironmentBake::size},
    EnvironmentField{camera_altitude_field, &EnvironmentBake::altitude},
    EnvironmentField{{.key = "sun_elevation",
                      .kind = Kind::angle,
                      .range = elevation_range,
                      .required = true,
                      .documentation = "elevation of the sun, which stands in the middle of a row",
                      .hint = "-90 deg to 90 deg"},
                     &EnvironmentBake::sun_elevation},
    EnvironmentField{orders_field, &EnvironmentBake::orders},
    EnvironmentField{layers_field, &EnvironmentBake::layers},
};

std::vector<Read> reads_of(const Parameters& parameters, const EnvironmentBake&) {
    return reads_of_air(parameters, Roles::all());
}

}  // namespace

const AssetKind& asset_kind(Tag<EnvironmentBake>) {
    static const auto rows = with_file_fields(environment_table, table_files);
    static const AssetKind kind = make_asset_kind<EnvironmentBake>(
        {.name = "environment",
         .documentation = "the sky and the ground around a camera, by longitude and latitude",
         .is_table = true,
         .needs_atmosphere = true,
         .use_of_light = UseOfLight::colors},
        std::span<const EnvironmentField>(rows), reads_of);
    return kind;
}

}  // namespace skybake::config
