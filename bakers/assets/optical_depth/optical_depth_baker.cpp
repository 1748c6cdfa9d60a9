// The baker of asset = "optical_depth".
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bakers/assets/optical_depth/column_kinds.h"
#include "bakers/assets/optical_depth/column_table.h"
#include "bakers/assets/optical_depth/column_volume.h"
#include "bakers/assets/registry/baker.h"
#include "bakers/field/baked.h"
#include "config/assets/optical_depth.h"

namespace skybake {
namespace {

using config::OpticalDepthBake;
using config::OpticalDepthTable;

ColumnTable table_of(const Parameters& parameters, const OpticalDepthBake& asset) {
    return {asset, column_geometry(make_column_kinds(parameters.atmosphere, asset.kinds))};
}

// Says at each probe what the lookups make of its value: columns.
void add_columns(const Parameters& parameters, const OpticalDepthBake& asset, Baked& baked) {
    const ColumnTable table = table_of(parameters, asset);
    for (Level& level : baked.levels) {
        for (Probe& probe : level.probes) {
            const double length_km = column_path_of(table, probe.at).length_km;
            for (const double value : probe.value) {
                probe.column_km.push_back(mean_density_of_stored(value) * length_km);
            }
        }
    }
}

Outcome<Baked> bake(const Parameters& parameters, const OpticalDepthBake& asset,
                    const BakeOptions& options, AssetLabel label) {
    Outcome<Baked> baked = bake_columns(parameters.atmosphere, asset, options,
                                        labelled_sky_volume(parameters, std::move(label)));
    const bool is_of_paths =
        asset.table != OpticalDepthTable::density && asset.table != OpticalDepthTable::phase;
    if (baked.value && is_of_paths) add_columns(parameters, asset, *baked.value);
    return baked;
}

Estimate estimate(const Parameters&, const OpticalDepthBake& asset) {
    return estimate_volume(asset, asset.size, 4, 1e-6);
}

AssetPlaces places(const Parameters& parameters, const OpticalDepthBake& asset,
                   const StoredTexels&) {
    const ColumnTable table = table_of(parameters, asset);
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

// Returns the lookup of a table over paths.
GlslFunction column_function(const ColumnTable& table, std::span<const int> size) {
    GlslFunction function;
    function.comment = "Returns the column of each kind, its density summed over the path in km";
    const auto set = [&](std::string_view comment, std::string_view arguments,
                         std::string_view name, std::string_view given) {
        function.comment += comment;
        function.arguments = arguments;
        function.value = fmt::format("{}(table, {}, air, {})", name, glsl_size(size), given);
    };
    switch (table.kind()) {
        case ColumnTableKind::to_top:
            size = size.first(2);
            set(", up to the top of the air. The ray must not meet the ground.",
                "sampler2D table, float altitude_km, float cos_zenith", "column_to_top",
                "altitude_km, cos_zenith");
            break;
        case ColumnTableKind::between_altitudes:
            set(", between points at two altitudes that are length_km apart. The path must not "
                "enter the ground.",
                "sampler3D table, float low_altitude_km, float high_altitude_km, float length_km",
                "column_between", "low_altitude_km, high_altitude_km, length_km");
            break;
        case ColumnTableKind::along_distance:
            set(", from an altitude along a ray.",
                "sampler3D table, float altitude_km, float cos_zenith, float length_km",
                "column_along", "altitude_km, cos_zenith, length_km");
            break;
    }
    return function;
}

AssetLookup lookup(const Parameters& parameters, const OpticalDepthBake& asset,
                   const StoredTexels& stored) {
    const ColumnTable table = table_of(parameters, asset);
    GlslFunction function;
    if (asset.table == OpticalDepthTable::phase) {
        function.comment =
            "Returns the phase functions in 1/sr. The unit vectors point along the view ray and to "
            "the sun.";
        function.arguments = "sampler2D table, vec3 view, vec3 sun";
        function.value =
            fmt::format("column_phase(table, {}, view, sun)", glsl_number(stored.size[0]));
    } else if (asset.table == OpticalDepthTable::density) {
        function.comment =
            "Returns the density of each kind, in shares of that which its coefficients are for.";
        function.arguments = "sampler2D table, float altitude_km";
        function.value =
            fmt::format("column_density(table, {}, air, altitude_km)", glsl_number(stored.size[0]));
    } else {
        function = column_function(table, stored.size);
    }
    function.comment +=
        fmt::format(" The kinds are, channel by channel: {}.", fmt::join(asset.kinds, ", "));
    if (asset.table != OpticalDepthTable::phase) {
        const ColumnGeometry& geometry = table.geometry();
        function.before = fmt::format(
            "    ColumnShell air;\n    air.R = {};\n    air.D = {};\n    air.fine = {};\n",
            glsl_number(geometry.shell.ground_radius_km), glsl_number(geometry.shell.thickness_km),
            glsl_number(geometry.scale.fine_km));
    }
    return {"columns", {with_channels(stored.channels, 4, std::move(function))}};
}

void draft(OpticalDepthBake& asset, int) {
    for (int& edge : asset.size) edge = std::min(edge, asset.size[2] > 1 ? 32 : 256);
    asset.mips = 1;
}

}  // namespace

Baker<config::OpticalDepthBake> baker(BakerTag<config::OpticalDepthBake>) {
    return {.version = 6,
            .bake = bake,
            .estimate = estimate,
            .places = places,
            .lookup = lookup,
            .draft = draft,
            .variants = {{"size"}, {"pixel_type"}, {"sampling"}}};
}

}  // namespace skybake
