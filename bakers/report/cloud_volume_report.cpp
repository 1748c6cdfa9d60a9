#include "bakers/report/cloud_volume_report.h"

#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "bakers/assets/cloud_volume/cloud_inputs.h"
#include "bakers/clouds/cloud_field.h"
#include "bakers/clouds/cloud_reference.h"
#include "bakers/report/sweeps/sweep.h"
#include "bakers/report/volume_report.h"
#include "config/assets/cloud_volume.h"
#include "config/sections/cloud_channels.h"
#include "config/sections/named_sections.h"

namespace skybake {

using cloud::CloudField;
using cloud::CloudPlan;
using config::CloudVolumeBake;
using config::Outcome;
using Voxels = std::shared_ptr<const VoxelSource>;

namespace {

CloudPlan plan_of(const config::Cloud& cloud, const CloudInputs& inputs,
                  const std::array<int, 3>& size) {
    return make_cloud_plan(cloud, *inputs.base, inputs.detail, size, inputs.maps);
}

// The same voxels without a bound on the noise, so that nothing is proved empty.
Voxels without_bounds(CloudPlan plan) {
    plan.noise_bound = std::numeric_limits<float>::infinity();
    return std::make_shared<CloudField>(std::move(plan));
}

VolumeSweep sweep_of(const config::Cloud& cloud, const CloudVolumeBake& asked,
                     const CloudInputs& inputs, const std::array<int, 3>& size, bool quick) {
    const auto make = [&](const std::array<int, 3>& voxels) -> Voxels {
        return std::make_shared<CloudField>(plan_of(cloud, inputs, voxels));
    };
    const CloudPlan plan = plan_of(cloud, inputs, size);
    VolumeSweep sweep = storage_sweep({asked, asked.size == size, size, plan.channels, make, {}},
                                      make(size), quick);
    VolumeVariant& variant = add_variant(sweep, "no region left out, bin, float", size_text(size),
                                         without_bounds(plan), size, config::PixelType::float32);
    variant.baseline = "noise at every voxel";
    variant.in_quadrature_sweep = true;
    return sweep;
}

}  // namespace

Outcome<AssetReport> report_cloud_volume(const config::Recipe& recipe, const config::Bake& bake,
                                         const ReportOptions& options) {
    const auto& asked = bake.as<CloudVolumeBake>();
    const config::Cloud& cloud = cloud_named(recipe.parameters, asked.cloud);
    Facts details;
    const Outcome<CloudInputs> inputs = cloud_inputs(recipe.parameters, asked, details);
    if (!inputs.value) return {{}, inputs.diagnostics};
    const std::size_t channels =
        config::cloud_channel_names(*inputs.value->base, cloud.channels).size();
    config::Bake subject = bake;
    auto& asset = subject.as<CloudVolumeBake>();
    asset.size =
        size_within(asked.size, max_report_values(options.quick) / static_cast<int>(channels));
    asset.mips = 1;
    const VolumeSweep sweep = sweep_of(cloud, asked, *inputs.value, asset.size, options.quick);
    const auto definition = std::make_shared<RememberedReference>(cloud::CloudReference(
        cloud, *inputs.value->base, inputs.value->detail, inputs.value->maps));
    const ReferenceOfSize reference = [definition](const std::array<int, 3>&) -> VolumeReference {
        return [definition](const std::array<double, 3>& place) { return (*definition)(place); };
    };
    return report_volume(recipe, {subject, asked.size, asked.mips, sweep, reference}, options);
}

}  // namespace skybake
