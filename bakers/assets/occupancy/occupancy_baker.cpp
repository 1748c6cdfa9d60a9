// The baker of asset = "occupancy".
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "bakers/assets/baker.h"
#include "bakers/assets/cloud_volume/cloud_inputs.h"
#include "bakers/assets/cloud_volume/cloud_volume.h"
#include "bakers/assets/occupancy/occupancy_grid.h"
#include "config/assets/cloud_volume.h"
#include "config/assets/occupancy.h"
#include "config/sections/parameters.h"

namespace skybake {

using config::Outcome;
using config::Parameters;

namespace {

using config::Cloud;
using config::CloudVolumeBake;
using config::OccupancyBake;

const CloudVolumeBake& volume_of(const Parameters& parameters, const OccupancyBake& asset) {
    return bake_named(parameters, asset.of).as<CloudVolumeBake>();
}

Outcome<Baked> bake(const Parameters& parameters, const OccupancyBake& asset,
                    const BakeOptions& options, AssetLabel label) {
    const CloudVolumeBake& of = volume_of(parameters, asset);
    const Cloud& cloud = cloud_named(parameters, of.cloud);
    Baked volume = labelled_volume(std::move(label));
    const Outcome<CloudInputs> inputs = cloud_inputs(parameters, of, volume.details);
    if (!inputs.value) return {{}, inputs.diagnostics};
    const Baked voxels = make_cloud_volume(cloud, of, *inputs.value, {});
    return bake_occupancy({voxels, filtered_threshold(cloud)}, asset, options, std::move(volume));
}

Estimate estimate(const Parameters& parameters, const OccupancyBake& asset) {
    const CloudVolumeBake& of = volume_of(parameters, asset);
    std::array<int, 3> cells{};
    for (std::size_t i = 0; i < 3; ++i) cells[i] = (of.size[i] + asset.cell - 1) / asset.cell;
    Estimate result = estimate_volume(asset, cells, asset.contents.size(), 1e-8);
    const Estimate voxels = estimate_cloud_volume(parameters, of);
    constexpr double kBytesPerCell = 4 + 4 + 1 + 1;  // minimum, maximum, leap, occupied
    result.seconds += voxels.seconds / 2;
    result.memory_mib += voxels.memory_mib + voxels_of(cells, 1) * kBytesPerCell / kMebibyte;
    return result;
}

// The cells of a level may go on beyond the volume that they are of.
AssetPlaces places(const Parameters& parameters, const OccupancyBake& asset, const StoredTexels&) {
    const CloudVolumeBake of = volume_of(parameters, asset);
    const Cloud cloud = spanned_cloud(parameters, of);
    AssetPlaces places = cloud_places(cloud, extent_m_of(cloud));
    places.lookups = [cloud, of, cell = asset.cell](const Probe& probe, int level) {
        Uvw extent_m = extent_m_of(cloud);
        for (std::size_t i = 0; i < 3; ++i) {
            const int edge = cell << level;
            const int cells = (of.size[i] + edge - 1) / edge;
            extent_m[i] *= static_cast<double>(edge) * cells / of.size[i];
        }
        return cloud_places(cloud, extent_m).lookups(probe, level);
    };
    return places;
}

void draft(OccupancyBake& asset, int) { asset.mips = 1; }

std::vector<InputFile> inputs(const Parameters& parameters, const OccupancyBake& asset) {
    return cloud_volume_inputs(parameters, volume_of(parameters, asset));
}

}  // namespace

const Baker<config::OccupancyBake>& baker(BakerTag<config::OccupancyBake>) {
    static const Baker<config::OccupancyBake> row = {.version = 2,
                                                     .bake = bake,
                                                     .estimate = estimate,
                                                     .places = places,
                                                     .draft = draft,
                                                     .inputs = inputs};
    return row;
}

}  // namespace skybake
