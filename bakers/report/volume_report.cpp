#include "bakers/report/volume_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "bakers/assets/cloud_volume/cloud_inputs.h"
#include "bakers/assets/optical_depth/column_volume.h"
#include "bakers/assets/registry/registry.h"
#include "bakers/clouds/cloud_field.h"
#include "bakers/clouds/cloud_reference.h"
#include "bakers/field/baked.h"
#include "bakers/noise/noise_plan.h"
#include "bakers/noise/noise_reference.h"
#include "bakers/report/sweeps/bruneton_sweep.h"
#include "bakers/report/sweeps/noise_volume_sweep.h"
#include "bakers/report/sweeps/sweep.h"
#include "bakers/report/sweeps/volume_sweep.h"
#include "config/assets/bruneton.h"
#include "config/assets/cloud_volume.h"
#include "config/assets/noise_volume.h"
#include "config/assets/optical_depth.h"
#include "config/sections/cloud.h"
#include "config/sections/parameters.h"

namespace skybake {

// --- Any volume ----------------------------------------------------------------------------------

using config::Outcome;

namespace {

// Files are written fewer times, because writing a compressed file takes ten times as long as
// making its voxels.
constexpr VolumeRepetitions kVolumeRepetitions = {.voxels = 9, .writes = 3};
constexpr VolumeRepetitions kQuickVolumeRepetitions = {.voxels = 3, .writes = 1};
// The numbers of points are those of --certify=full and --certify=quick.
constexpr int kPoints = 16384;
constexpr int kQuickPoints = 1024;

AssetReport describe(const Baked& volume, const VolumeReportSubject& subject, bool quick) {
    const VolumeRepetitions repetitions = quick ? kQuickVolumeRepetitions : kVolumeRepetitions;
    AssetReport report;
    report.name = volume.name;
    report.kind = volume.kind;
    report.reference = volume.certificate.reference;
    report.scale = fmt::format("{}, at {} as baked", volume.certificate.scale,
                               size_text(volume.levels.front().size));
    report.timing =
        subject.timing.empty() ? "processor time of the voxels, one thread" : subject.timing;
    const int points = quick ? kQuickPoints : kPoints;
    report.lookup_points = report.texel_points = subject.points > 0 ? subject.points : points;
    report.repetitions = subject.repetitions > 0 ? subject.repetitions : repetitions.voxels;
    report.volume = VolumeFacts{volume.channel_names, volume.levels.front().statistics,
                                volume.seam_error, repetitions.writes};
    if (volume.levels.front().size != subject.asked_size) {
        report.notes.push_back(
            fmt::format("{}: left out, since it has too many voxels to be measured{}; all figures "
                        "are of smaller volumes",
                        size_text(subject.asked_size), quick ? " quickly" : ""));
    }
    if (subject.asked_mips > 1) {
        report.notes.emplace_back("files hold only the first level of detail");
    }
    return report;
}

}  // namespace

Outcome<AssetReport> report_volume(const config::Recipe& recipe, const VolumeReportSubject& subject,
                                   const ReportOptions& options) {
    Outcome<Baked> baked = bake_asset(recipe, subject.bake,
                                      BakeOptions{.threads = options.threads,
                                                  .progress = options.progress,
                                                  .intermediates = options.intermediates});
    if (options.progress != nullptr && options.progress->cancelled()) return {};
    Outcome<AssetReport> outcome;
    outcome.diagnostics = std::move(baked.diagnostics);
    if (!baked.value) return outcome;
    const Baked& volume = *baked.value;
    AssetReport report = describe(volume, subject, options.quick);
    auto measured = measure_volume_sweep(
        subject.sweep, volume, subject.reference, report.lookup_points,
        options.quick ? kQuickVolumeRepetitions : kVolumeRepetitions, options, subject.comparison);
    if (!measured) return {};
    report.rows = std::move(measured->rows);
    report.notes.insert(report.notes.end(), measured->notes.begin(), measured->notes.end());
    outcome.value = std::move(report);
    return outcome;
}

// --- Tables of Bruneton's ------------------------------------------------------------------------

using config::BrunetonBake;
using config::BrunetonTable;

config::Outcome<AssetReport> report_bruneton(const config::Recipe& recipe, const config::Bake& bake,
                                             const ReportOptions& options) {
    if (config::holds_colors(recipe.parameters)) return nothing_to_compare(bake);
    const auto& asked = bake.as<BrunetonBake>();
    const bool is_flat =
        asked.table == BrunetonTable::transmittance || asked.table == BrunetonTable::irradiance;
    const config::Atmosphere& atmosphere = recipe.parameters.atmosphere;
    const auto made = is_flat ? bruneton_flat_sweep(atmosphere, asked, options)
                              : bruneton_scattering_sweep(atmosphere, asked, options);
    if (!made) return {};
    config::Bake subject = bake;
    auto& asset = subject.as<BrunetonBake>();
    asset.size = made->size;
    asset.mips = 1;
    // The solved method is the one that the other is measured against.
    asset.method = config::BrunetonMethod::solved;
    return report_volume(recipe,
                         {subject,
                          asked.size,
                          asked.mips,
                          made->sweep,
                          made->reference,
                          {},
                          made->points,
                          made->repetitions,
                          "processor time of the voxels and of the light that they need, one "
                          "thread"},
                         options);
}

// --- Clouds --------------------------------------------------------------------------------------

using cloud::CloudField;
using cloud::CloudPlan;
using config::CloudVolumeBake;
using config::Outcome;
using Voxels = std::shared_ptr<const VoxelSource>;

namespace {

// Returns the same voxels, made without a bound on the noise, so that no box is known to be empty.
Voxels without_bounds(CloudPlan plan) {
    plan.noise_bound = std::numeric_limits<float>::infinity();
    return std::make_shared<CloudField>(std::move(plan));
}

// The definition of a cloud of noise is the same at every size, and its values are remembered. That of
// a cloud of a volume is filtered for the size of its voxels.
ReferenceOfSize references_of_cloud(const config::Cloud& cloud, const CloudInputs& inputs) {
    if (inputs.volume) {
        return [cloud, inputs](const std::array<int, 3>& size) -> VolumeReference {
            const auto definition =
                std::make_shared<cloud::CloudReference>(reference_of_cloud(cloud, inputs, size));
            return
                [definition](const std::array<double, 3>& place) { return (*definition)(place); };
        };
    }
    const auto definition =
        std::make_shared<RememberedReference>(reference_of_cloud(cloud, inputs, {}));
    return [definition](const std::array<int, 3>&) -> VolumeReference {
        return [definition](const std::array<double, 3>& place) { return (*definition)(place); };
    };
}

VolumeSweep sweep_of(const config::Cloud& cloud, const CloudVolumeBake& asked,
                     const CloudInputs& inputs, const std::array<int, 3>& size, bool quick) {
    const auto make = [&](const std::array<int, 3>& voxels) -> Voxels {
        return std::make_shared<CloudField>(plan_of_cloud(cloud, inputs, voxels));
    };
    const CloudPlan plan = plan_of_cloud(cloud, inputs, size);
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
        config::cloud_channel_names(inputs.value->base, cloud.channels).size();
    config::Bake subject = bake;
    auto& asset = subject.as<CloudVolumeBake>();
    asset.size =
        size_within(asked.size, max_report_values(options.quick) / static_cast<int>(channels));
    asset.mips = 1;
    const VolumeSweep sweep = sweep_of(cloud, asked, *inputs.value, asset.size, options.quick);
    return report_volume(
        recipe, {subject, asked.size, asked.mips, sweep, references_of_cloud(cloud, *inputs.value)},
        options);
}

// --- Columns -------------------------------------------------------------------------------------

using config::DepthSampling;
using config::OpticalDepthBake;

namespace {

// The most texels along an axis. It is small because summing hundreds of shells along each path is
// slow.
constexpr int kMostColumnTexels = 32;

// The altitude up to which shells go if the recipe does not say, from Ai et al. 2014.
constexpr config::Length kPaperAltitude = {35e3};

void add(const config::Atmosphere& atmosphere, const OpticalDepthBake& bake,
         const OpticalDepthBake& asked, const std::string& family, const std::string& name,
         const std::string& baseline, VolumeSweep& sweep) {
    VolumeVariant& variant = add_variant(
        sweep, family, name, column_voxels(atmosphere, bake).voxels, bake.size, bake.pixel_type);
    variant.baseline = baseline;
    variant.in_quadrature_sweep = true;
    variant.of_recipe = bake.size == asked.size && bake.sampling == asked.sampling &&
                        (bake.sampling == DepthSampling::exact || bake.shells == asked.shells);
}

VolumeSweep column_sweep(const config::Atmosphere& atmosphere, const OpticalDepthBake& bake,
                         const OpticalDepthBake& asked, bool quick) {
    VolumeSweep sweep;
    OpticalDepthBake variant = bake;
    variant.sampling = DepthSampling::exact;
    add(atmosphere, variant, asked, "exact", "quadrature", "", sweep);
    std::vector<int> counts = {8, 16, 32, 64};
    if (!quick) counts.insert(counts.end(), {128, 256});
    for (const auto& [sampling, family, baseline] :
         {std::tuple{DepthSampling::equal_attenuation, "equal attenuation", "after Ai et al. 2014"},
          std::tuple{DepthSampling::uniform, "uniform shells", ""}}) {
        variant.sampling = sampling;
        for (const int count : counts) {
            variant.shells = count;
            add(atmosphere, variant, asked, family, fmt::format("{} shells", count), baseline,
                sweep);
        }
    }
    return sweep;
}

}  // namespace

config::Outcome<AssetReport> report_column_volume(const config::Recipe& recipe,
                                                  const config::Bake& bake,
                                                  const ReportOptions& options) {
    const auto& asked = bake.as<OpticalDepthBake>();
    const bool sums = asked.table == config::OpticalDepthTable::to_top ||
                      asked.table == config::OpticalDepthTable::between;
    if (!sums) return nothing_to_compare(bake);
    const config::Atmosphere& atmosphere = recipe.parameters.atmosphere;
    config::Bake subject = bake;
    auto& asset = subject.as<OpticalDepthBake>();
    asset.mips = 1;
    if (asset.table == config::OpticalDepthTable::between) {
        for (int& texels : asset.size) texels = std::min(texels, kMostColumnTexels);
    }
    if (asset.sampling == DepthSampling::exact) asset.max_altitude = kPaperAltitude;
    const VolumeSweep sweep = column_sweep(atmosphere, asset, asked, options.quick);
    const auto of_size = [&](const std::array<int, 3>& size) {
        OpticalDepthBake sized = asset;
        sized.size = size;
        return column_voxels(atmosphere, sized);
    };
    const ReferenceOfSize reference = [&](const std::array<int, 3>& size) {
        const auto remembered = std::make_shared<RememberedReference>(of_size(size).reference);
        return [remembered](const std::array<double, 3>& uvw) { return (*remembered)(uvw); };
    };
    return report_volume(recipe,
                         {subject, asked.size, asked.mips, sweep, reference,
                          [&](const std::array<int, 3>& size) { return of_size(size).comparison; }},
                         options);
}

// --- Noises --------------------------------------------------------------------------------------

using config::Noise;
using config::NoiseVolumeBake;
using config::Outcome;

namespace {

// Returns the reference by texture coordinates, for a volume of any size.
ReferenceOfSize reference_of(const Noise& noise) {
    const auto remembered =
        std::make_shared<RememberedReference>([&noise](const std::array<double, 3>& place) {
            return noise::noise_reference(noise, place);
        });
    return [&noise, remembered](const std::array<int, 3>& size) -> VolumeReference {
        const std::array<noise::TileAxis, 3> axes = noise::tile_axes(size, noise.sampling);
        return [remembered, axes](const std::array<double, 3>& uvw) {
            std::array<double, 3> place = uvw;
            for (std::size_t i = 0; i < 3; ++i) {
                // The centre of voxel i is at (i + 1/2) / size, but the voxel may sample its lower
                // corner.
                if (axes[i].offset == 0) place[i] -= 0.5 / axes[i].size;
            }
            return (*remembered)(place);
        };
    };
}

}  // namespace

Outcome<AssetReport> report_noise_volume(const config::Recipe& recipe, const config::Bake& bake,
                                         const ReportOptions& options) {
    const auto& asked = bake.as<NoiseVolumeBake>();
    const Noise& noise = noise_named(recipe.parameters, asked.noise);
    config::Bake subject = bake;
    auto& asset = subject.as<NoiseVolumeBake>();
    asset.size = report_size(noise, asked, options.quick);
    asset.mips = 1;
    const VolumeSweep sweep = noise_volume_sweep(noise, asked, asset.size, options.quick);
    return report_volume(recipe, {subject, asked.size, asked.mips, sweep, reference_of(noise)},
                         options);
}

}  // namespace skybake
