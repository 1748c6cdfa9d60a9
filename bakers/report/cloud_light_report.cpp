#include "bakers/report/cloud_light_report.h"

#include <fmt/format.h>

#include <functional>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "bakers/assets/cloud_light/cloud_layer.h"
#include "bakers/assets/cloud_light/cloud_light_truth.h"
#include "bakers/assets/cloud_light/cloud_light_volume.h"
#include "bakers/assets/cloud_light/layer_sky.h"
#include "bakers/assets/cloud_volume/cloud_inputs.h"
#include "bakers/assets/cloud_volume/cloud_volume.h"
#include "bakers/assets/occupancy/occupancy_grid.h"
#include "bakers/field/baked.h"
#include "bakers/field/block_voxels.h"
#include "bakers/report/sweeps/sweep.h"
#include "bakers/report/sweeps/volume_sweep.h"
#include "bakers/report/volume_report.h"
#include "config/assets/cloud_light.h"
#include "config/assets/cloud_volume.h"
#include "config/sections/parameters.h"

namespace skybake {

using cloud_light::CloudLayer;
using config::CloudLightBake;
using config::CloudVolumeBake;
using config::Outcome;

namespace {

constexpr int kLightRepetitions = 3;
constexpr int kLightPoints = 4096;
constexpr int kQuickLightPoints = 512;

Outcome<CloudLayer> layer_of(const config::Recipe& recipe, const CloudLightBake& asked,
                             const std::string& name, const BakeOptions& options) {
    const auto& of = bake_named(recipe.parameters, asked.of).as<CloudVolumeBake>();
    Facts details;
    const Outcome<CloudInputs> inputs = cloud_inputs(recipe.parameters, of, details, options);
    if (!inputs.value) return {{}, inputs.diagnostics};
    Baked voxels =
        hold_cloud_volume(cloud_named(recipe.parameters, of.cloud), of, *inputs.value, options, {});
    if (options.cancelled()) return {};
    code_levels(voxels);
    const config::Cloud cloud = spanned_cloud(recipe.parameters, of);
    CloudLayer layer =
        cloud_light::make_layer(voxels, channel_named(voxels, asked.channel), cloud, options);
    if (const auto problem =
            cloud_light::add_sky(recipe.parameters, asked, cloud, name, options, layer)) {
        return {{}, {*problem}};
    }
    if (options.cancelled()) return {};
    return {std::move(layer), {}};
}

// Makes the texels on one thread and adds them with the processor time that they took.
void add_texels(const CloudLayer& layer, const CloudLightBake& bake, const CloudLightBake& asked,
                bool is_fitted, const ReportOptions& options, VolumeSweep& sweep) {
    BakeOptions one;
    one.threads = 1;
    one.progress = options.progress;
    const int spacing = is_fitted ? cloud_light_spacing(bake) : bake.cell;
    std::shared_ptr<const VoxelSource> texels;
    Facts details;
    const std::vector<double> seconds = interleaved_medians(
        {[&] { texels = cloud_light_texels(layer, bake, spacing, one, details); }},
        options.quick ? 1 : kLightRepetitions, [](int, std::size_t) { return true; });
    if (!texels) return;
    VolumeVariant& variant = add_variant(
        sweep, is_fitted ? "fitted" : "at centres", fmt::format("{} voxels a texel", bake.cell),
        std::move(texels), cloud_light_size(layer.size, bake), bake.pixel_type);
    variant.seconds = seconds[0];
    variant.of_recipe = is_fitted && !asked.max_error && bake.cell == asked.cell;
    if (!is_fitted) variant.baseline = "values at the centres of texels";
}

VolumeSweep sweep_of(const CloudLayer& layer, const CloudLightBake& asked,
                     const ReportOptions& options) {
    std::set<int> cells = {4, 8, asked.cell};
    if (!options.quick) cells.insert({2, 3, 6, 16});
    VolumeSweep sweep;
    for (const int cell : cells) {
        CloudLightBake bake = asked;
        bake.cell = cell;
        add_texels(layer, bake, asked, true, options, sweep);
        if (cell > 1) add_texels(layer, bake, asked, false, options, sweep);
    }
    return sweep;
}

}  // namespace

Outcome<AssetReport> report_cloud_light(const config::Recipe& recipe, const config::Bake& bake,
                                        const ReportOptions& options) {
    const auto& asked = bake.as<CloudLightBake>();
    const BakeOptions with{.threads = options.threads,
                           .progress = options.progress,
                           .intermediates = options.intermediates};
    const Outcome<CloudLayer> layer = layer_of(recipe, asked, bake.name, with);
    if (!layer.value) return {{}, layer.diagnostics};
    config::Bake subject = bake;
    subject.as<CloudLightBake>().mips = 1;
    const VolumeSweep sweep = sweep_of(*layer.value, asked, options);
    const CloudLightTruth truth = cloud_light_truth(*layer.value, asked, options.threads);
    const auto remembered = std::make_shared<RememberedReference>(truth.reference);
    const ReferenceOfSize reference = [remembered](const std::array<int, 3>&) -> VolumeReference {
        return [remembered](const std::array<double, 3>& place) { return (*remembered)(place); };
    };
    const ComparisonOfSize comparison = [&truth](const std::array<int, 3>&) {
        return truth.comparison;
    };
    return report_volume(recipe,
                         {subject, cloud_light_size(layer.value->size, asked), asked.mips, sweep,
                          reference, comparison, options.quick ? kQuickLightPoints : kLightPoints,
                          options.quick ? 1 : kLightRepetitions,
                          "processor time of the texels, the cloud's voxels being in memory, one "
                          "thread"},
                         options);
}

}  // namespace skybake
