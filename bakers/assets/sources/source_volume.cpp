#include "bakers/assets/sources/source_volume.h"

#include <fmt/format.h>

#include <utility>

#include "bakers/assets/cloud_volume/cloud_inputs.h"
#include "bakers/field/baked.h"
#include "bakers/field/block_voxels.h"

namespace skybake {

const CloudVolumeBake& source_volume(const Parameters& parameters, const std::string& of) {
    return bake_named(parameters, of).as<CloudVolumeBake>();
}

Outcome<Baked> hold_source_volume(const Parameters& parameters, const std::string& of,
                                  const BakeOptions& options, Facts& details) {
    const CloudVolumeBake& bake = source_volume(parameters, of);
    const Outcome<CloudInputs> inputs = cloud_inputs(parameters, bake, details, options);
    if (!inputs.value) return {{}, inputs.diagnostics};
    Baked voxels =
        hold_cloud_volume(cloud_named(parameters, bake.cloud), bake, *inputs.value, options, {});
    if (options.cancelled()) return {};
    code_levels(voxels);
    return {std::move(voxels), {}};
}

bool is_marched_as_stored(const Cloud& cloud) {
    return cloud.channels != config::CloudChannels::noise &&
           cloud.threshold_at == config::ThresholdAt::bake;
}

Uvw spanned_m(const occupancy::CellGrid& grid, const Cloud& cloud) {
    const std::array<int, 3> blocks = grid.size();
    Uvw extent_m = extent_m_of(cloud);
    for (std::size_t i = 0; i < 3; ++i) {
        extent_m[i] *= static_cast<double>(grid.cell) * blocks[i] / grid.voxels[i];
    }
    return extent_m;
}

void place_blocks(const Baked& of, const occupancy::CellGrid& grid, const BlockWords& words,
                  Baked& volume) {
    const std::array<int, 3> blocks = grid.size();
    volume.mapping = of.mapping;
    volume.axes = of.axes;
    for (std::size_t i = 0; i < 3; ++i) {
        const double edge = of.voxel_size_m[i] * grid.cell;
        AxisMapping& axis = volume.axes[i];
        axis.last = axis.first + edge * blocks[i];
        const double extent = axis.last - axis.first;
        axis.formula =
            fmt::format("{} = ({} - {}) / {}", "uvw"[i], axis.quantity, axis.first, extent);
        axis.convention = fmt::format("{}; {}", i < 2 ? "repeats" : "clamped", words.place);
        axis.filter = words.filter;
        axis.constants = {{"first_m", axis.first},
                          {"extent_m", extent},
                          {fmt::format("{}_m", words.block), edge},
                          {fmt::format("{}_voxels", words.block), static_cast<double>(grid.cell)}};
        volume.voxel_size_m[i] = edge;
    }
    volume.minimum_m = of.minimum_m;
    volume.up_axis = of.up_axis;
    volume.conventions = of.conventions;
}

}  // namespace skybake
