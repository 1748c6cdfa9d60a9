// The baker of asset = "occupancy".
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "bakers/assets/cloud_volume/cloud_volume.h"
#include "bakers/assets/occupancy/occupancy_grid.h"
#include "bakers/assets/registry/baker.h"
#include "bakers/assets/sources/source_volume.h"
#include "bakers/field/baked.h"
#include "bakers/occupancy/occupied_cells.h"
#include "config/assets/cloud_volume.h"
#include "config/assets/occupancy.h"
#include "config/sections/parameters.h"

namespace skybake {
namespace {

Outcome<Baked> bake(const Parameters& parameters, const OccupancyBake& asset,
                    const BakeOptions& options, AssetLabel label) {
    const CloudVolumeBake& of = source_volume(parameters, asset.of);
    const Cloud& cloud = cloud_named(parameters, of.cloud);
    Baked volume = labelled_volume(std::move(label));
    const Outcome<Baked> held = hold_source_volume(parameters, asset.of, options, volume.details);
    if (!held.value) return {{}, held.diagnostics};
    const Baked& voxels = *held.value;
    return bake_occupancy({voxels, filtered_threshold(cloud)}, asset, options, std::move(volume));
}

Estimate estimate(const Parameters& parameters, const OccupancyBake& asset) {
    const CloudVolumeBake& of = source_volume(parameters, asset.of);
    const std::array<int, 3> cells = occupancy::CellGrid{of.size, asset.cell}.size();
    Estimate result = estimate_volume(asset, cells, asset.contents.size(), 1e-8);
    const Estimate voxels = estimate_cloud_volume(parameters, of);
    // Minimum, maximum, leap and occupied, and bits of voxels.
    const double bytes = voxels_of(cells, 1) * (4 + 4 + 1 + 1) + voxels_of(of.size, 1) / 8;
    result.seconds += voxels.seconds / 2;
    result.memory_mib += voxels.memory_mib + bytes / kMebibyte;
    return result;
}

// The cells of a level may go on beyond the volume that they are of.
AssetPlaces places(const Parameters& parameters, const OccupancyBake& asset, const StoredTexels&) {
    const CloudVolumeBake of = source_volume(parameters, asset.of);
    const Cloud cloud = spanned_cloud(parameters, of);
    AssetPlaces places = cloud_places(cloud, extent_m_of(cloud));
    places.lookups = [cloud, of, cell = asset.cell](const Probe& probe, int level) {
        return cloud_places(cloud, spanned_m({of.size, cell << level}, cloud))
            .lookups(probe, level);
    };
    return places;
}

// Voxels along the edge of a cell of a level with so many cells. A file of a level does not say
// which it is.
int cell_of_level(const OccupancyBake& asset, const CloudVolumeBake& of,
                  const std::vector<int>& cells) {
    int cell = asset.cell;
    for (int level = 1; level < asset.mips; ++level) {
        if (!std::ranges::equal(occupancy::CellGrid{of.size, cell}.size(), cells)) cell *= 2;
    }
    return cell;
}

// 255 or 1 in the channel of leaps; empty where the grid has none.
std::string full_leap(const OccupancyBake& asset) {
    const auto leap = std::ranges::find(asset.contents, config::OccupancyContent::leap);
    if (leap == asset.contents.end()) return {};
    std::array<std::string, 4> full = {"0.0", "0.0", "0.0", "0.0"};
    full[static_cast<std::size_t>(leap - asset.contents.begin())] =
        occupancy::is_unorm(asset.pixel_type) ? "255.0" : "1.0";
    return fmt::format("vec4({})", fmt::join(full, ", "));
}

GlslFunction leap_function(const std::string& grid, const std::string& voxels,
                           const std::string& box) {
    return {
        .comment =
            "Returns how far the ray goes on from p, in metres, before it leaves the cells that "
            "are known to be empty; 0 where p is in a cell that is not.",
        .result = "float",
        .arguments = "sampler3D cells, vec3 p, vec3 ray",
        .value = fmt::format("cloud_leap(cells, {}, {}, p - corner, ray, tile)", grid, voxels),
        .before = box,
        .suffix = "_leap"};
}

AssetLookup lookup(const Parameters& parameters, const OccupancyBake& asset,
                   const StoredTexels& stored) {
    const CloudVolumeBake& of = source_volume(parameters, asset.of);
    const Cloud cloud = spanned_cloud(parameters, of);
    const std::string box = cloud_box_glsl(cloud);
    std::string grid = fmt::format("{}, {}", glsl_size(stored.size),
                                   glsl_number(cell_of_level(asset, of, stored.size)));
    const std::string voxels = glsl_size(of.size);
    GlslFunction function;
    function.comment =
        "Returns the channels of the cell at x and y in metres and at the altitude z in metres.";
    function.arguments = "sampler3D cells, vec3 p";
    function.before =
        box + fmt::format("    ivec3 at = cloud_cell({}, {}, p - corner, tile);\n", grid, voxels);
    function.value = "texelFetch(cells, at, 0)";
    AssetLookup lookup = {"clouds", {with_channels(stored.channels, 4, std::move(function))}};
    const std::string full = full_leap(asset);
    if (full.empty()) return lookup;
    grid += ", " + full;
    lookup.functions.push_back(leap_function(grid, voxels, box));
    if (is_marched_as_stored(cloud)) {
        lookup.functions.push_back(march_function(
            "cells", fmt::format("cloud_march(cloud, cells, {}, {}", grid, voxels), box));
        lookup.functions.back().suffix = "_march";
    }
    return lookup;
}

void draft(OccupancyBake& asset, int) { asset.mips = 1; }

}  // namespace

Baker<OccupancyBake> baker(BakerTag<OccupancyBake>) {
    return {.version = 7,
            .bake = bake,
            .estimate = estimate,
            .needs = needs_of_source<OccupancyBake>,
            .places = places,
            .lookup = lookup,
            .draft = draft,
            .inputs = inputs_of_source<OccupancyBake>};
}

}  // namespace skybake
