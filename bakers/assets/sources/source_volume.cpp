#include "bakers/assets/sources/source_volume.h"

#include <utility>

#include "bakers/assets/cloud_volume/cloud_inputs.h"
#include "bakers/field/baked.h"
#include "bakers/field/block_voxels.h"

namespace skybake {

const config::CloudVolumeBake& source_volume(const config::Parameters& parameters,
                                             const std::string& of) {
    return bake_named(parameters, of).as<config::CloudVolumeBake>();
}

config::Outcome<Baked> hold_source_volume(const config::Parameters& parameters,
                                          const std::string& of, const BakeOptions& options,
                                          Baked& made) {
    const config::CloudVolumeBake& bake = source_volume(parameters, of);
    const config::Outcome<CloudInputs> inputs =
        cloud_inputs(parameters, bake, made.details, options);
    if (!inputs.value) return {{}, inputs.diagnostics};
    Baked voxels =
        hold_cloud_volume(cloud_named(parameters, bake.cloud), bake, *inputs.value, options, {});
    if (options.cancelled()) return {};
    code_levels(voxels);
    return {std::move(voxels), {}};
}

bool is_marched_as_stored(const config::Cloud& cloud) {
    return cloud.channels == config::CloudChannels::density &&
           cloud.threshold_at == config::ThresholdAt::bake;
}

}  // namespace skybake
