// The baker of asset = "optical_depth".
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "bakers/assets/baker.h"
#include "bakers/assets/optical_depth/column_kinds.h"
#include "bakers/assets/optical_depth/column_table.h"
#include "bakers/assets/optical_depth/column_volume.h"
#include "bakers/field/image.h"
#include "config/assets/optical_depth.h"

namespace skybake {

using config::Outcome;
using config::Parameters;

namespace {

using config::OpticalDepthBake;
using config::OpticalDepthTable;

Outcome<Baked> bake(const Parameters& parameters, const OpticalDepthBake& asset,
                    const BakeOptions& options, AssetLabel label) {
    return bake_columns(parameters.atmosphere, asset, options,
                        labelled_sky_volume(parameters, std::move(label)));
}

Estimate estimate(const Parameters&, const OpticalDepthBake& asset) {
    return estimate_volume(asset, asset.size, 4, 1e-6);
}

AssetPlaces places(const Parameters& parameters, const OpticalDepthBake& asset,
                   const StoredTexels&) {
    const ColumnTable table(asset,
                            column_geometry(make_column_kinds(parameters.atmosphere, asset.kinds)));
    const int size = asset.size[0];
    const auto along_u = [size](double x) {
        return Uvw{texture_coordinate(TexelConvention::end_points_on_texel_centres, x, size), 0.5,
                   0.5};
    };
    if (asset.table == OpticalDepthTable::density) {
        return single_lookup({"altitude_km"}, [table, along_u](const Place& at) {
            return along_u(scaled_altitude(table.geometry().scale, at[0].second));
        });
    }
    if (asset.table == OpticalDepthTable::phase) {
        return single_lookup({"scattering_angle_deg"}, [along_u](const Place& at) {
            return along_u(std::sqrt(at[0].second / 180));
        });
    }
    std::vector<std::string> names = {"altitude_km", "cos_zenith"};
    if (table.kind() == ColumnTableKind::between_altitudes) {
        names = {"low_altitude_km", "high_altitude_km", "angle_at_centre_deg"};
    } else if (table.kind() == ColumnTableKind::along_distance) {
        names.emplace_back("length_km");
    }
    return single_lookup(std::move(names), [table](const Place& at) {
        return column_texture_coordinates(table, at);
    });
}

void draft(OpticalDepthBake& asset, int) {
    for (int& edge : asset.size) edge = std::min(edge, asset.size[2] > 1 ? 32 : 256);
    asset.mips = 1;
}

}  // namespace

const Baker<config::OpticalDepthBake>& baker(BakerTag<config::OpticalDepthBake>) {
    static const Baker<config::OpticalDepthBake> row = {
        .version = 2, .bake = bake, .estimate = estimate, .places = places, .draft = draft};
    return row;
}

}  // namespace skybake
