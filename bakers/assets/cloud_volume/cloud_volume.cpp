#include "bakers/assets/cloud_volume/cloud_volume.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

#include "bakers/clouds/cloud_field.h"
#include "bakers/field/baked.h"
#include "bakers/field/finish_volume.h"

namespace skybake {
namespace {

using cloud::CloudField;
using cloud::CloudReference;

std::vector<AxisMapping> axes_of(const Cloud& cloud) {
    const auto [corner_x, corner_y, base] = corner_m_of(cloud);
    std::vector<AxisMapping> axes(3);
    for (std::size_t i = 0; i < 2; ++i) {
        const char letter = "xy"[i];
        const double first = i == 0 ? corner_x : corner_y;
        axes[i].quantity = i == 0 ? "x_m" : "y_m";
        axes[i].first = first;
        axes[i].last = first + cloud.extent[i].meters;
        axes[i].formula = fmt::format(
            "{} = {} / {}", "uv"[i],
            first == 0 ? std::string(1, letter) : fmt::format("({} - {})", letter, first),
            cloud.extent[i].meters);
        axes[i].convention = "repeats; voxel i samples (i + 1/2) / size";
        axes[i].wrap = AxisWrap::repeat;
    }
    axes[2].quantity = "altitude_m";
    axes[2].first = base;
    axes[2].last = base + cloud.extent[2].meters;
    axes[2].formula = fmt::format("w = (altitude - {}) / {}", base, cloud.extent[2].meters);
    axes[2].convention = "clamped; voxel i samples (i + 1/2) / size";
    for (AxisMapping& axis : axes) {
        axis.end_points = TexelConvention::end_points_on_edges;
        axis.constants = {{"first_m", axis.first}, {"extent_m", axis.last - axis.first}};
    }
    return axes;
}

std::string content_of(const Cloud& cloud) {
    const double extinction = cloud.extinction_scale.per_meter;
    if (cloud.threshold_at == config::ThresholdAt::bake) {
        return fmt::format(
            "cloud density, dimensionless; extinction is density * {} /m{}", extinction,
            cloud.channels == config::CloudChannels::velocity ? "; velocity of the flow in m/s"
                                                              : "");
    }
    return fmt::format(
        "cloud value v before its threshold, dimensionless; density is v * smoothstep({}, {}, v), "
        "extinction is density * {} /m",
        cloud.threshold, cloud.threshold + cloud.edge_softness, extinction);
}

// Adds what a runtime needs to know beyond the axes.
void add_details(const Cloud& cloud, const cloud::CloudPlan& plan, Baked& volume) {
    const auto add = [&](const char* key, FactValue value) {
        volume.details.emplace_back(key, std::move(value));
    };
    const bool in_file = cloud.threshold_at == config::ThresholdAt::bake;
    add("threshold", cloud.threshold);
    add("edge_softness", cloud.edge_softness);
    add("threshold_at", in_file ? "bake" : "runtime");
    if (cloud.full_at) add("full_at", *cloud.full_at);
    add("extinction_scale_per_m", cloud.extinction_scale.per_meter);
    if (cloud.particles == config::CloudParticles::ice) add("particles", "ice");
    if (plan.flow && config::cloud_moves(cloud)) {
        add("flow_seconds_per_frame", 60 * cloud.convection.loop_minutes / cloud.period);
    }
    add("shaped_channels", static_cast<double>(plan.shaped_channels));
}

// The grids' names: density first, since runtimes look for it.
std::vector<std::string> grid_names(const std::vector<std::string>& channels) {
    std::vector<std::string> names = channels;
    names.front() = "density";
    return names;
}

ProbePlace place_of(const Cloud& cloud, const std::array<double, 3>& uvw) {
    const Uvw corner = corner_m_of(cloud);
    return {{{"x_m", corner[0] + uvw[0] * cloud.extent[0].meters},
             {"y_m", corner[1] + uvw[1] * cloud.extent[1].meters},
             {"altitude_m", corner[2] + uvw[2] * cloud.extent[2].meters}},
            {{uvw}}};
}

// Returns the plan with the noises a tile's length away.
cloud::CloudPlan tile_beyond(cloud::CloudPlan plan, std::size_t axis) {
    for (auto* field : {&plan.base, &plan.detail}) {
        if (*field == nullptr) continue;
        *field =
            std::make_shared<const noise::NoiseField>(noise::tile_beyond((*field)->plan(), axis));
    }
    return plan;
}

// A tile's length away noises, maps and towers are asked again. Volumes repeat there by the integers of
// their voxels.
double seam_error_of(const CloudField& field) {
    const cloud::CloudPlan& plan = field.plan();
    const std::array beyond = {tile_beyond(plan, 0), tile_beyond(plan, 1)};
    return seam_error(
        field, plan.size, static_cast<std::size_t>(plan.channels), 2,
        [&](std::size_t axis, const VoxelBox& voxel, const std::vector<float*>& channels) {
            std::array<int, 3> far = voxel.origin;
            far[axis] = plan.size[axis];
            cloud::Columns column = cloud::make_columns(plan, far[0], 1, far[1], 1);
            column.first_x = voxel.origin[0];
            column.first_y = voxel.origin[1];
            cloud::fill_cloud(beyond[axis], column, voxel, channels);
        });
}

std::shared_ptr<const CloudField> make_field(const Cloud& cloud, const CloudVolumeBake& bake,
                                             const CloudInputs& inputs) {
    return std::make_shared<const CloudField>(plan_of_cloud(cloud, inputs, bake.size));
}

std::string extent_to_string(const std::array<config::Length, 3>& extent) {
    return fmt::format("{} x {} x {} m", extent[0].meters, extent[1].meters, extent[2].meters);
}

Baked describe(const Cloud& recipe_cloud, const CloudVolumeBake& bake, const CloudInputs& inputs,
               std::shared_ptr<const CloudField> field, Baked volume) {
    const Cloud cloud = config::stretched(recipe_cloud, bake);
    volume.kind = "cloud_volume";
    volume.content = content_of(cloud);
    volume.mapping = "layer";
    volume.axes = axes_of(cloud);
    volume.channel_names = config::cloud_channel_names(inputs.base, cloud.channels);
    volume.grid_names = grid_names(volume.channel_names);
    volume.sparse = true;
    set_files(bake, volume);
    volume.voxel_size_m = config::voxel_edges(cloud, bake);
    volume.minimum_m = corner_m_of(cloud);
    volume.up_axis = "+z";
    volume.conventions.length_unit = "m";
    volume.conventions.coefficient_unit = "1/m";
    volume.conventions.up_axis = volume.up_axis;
    add_details(cloud, field->plan(), volume);
    if (bake.extent[0].meters > 0) {
        volume.details.emplace_back(
            "extent",
            fmt::format("{}, to which the cloud's {} are stretched", extent_to_string(cloud.extent),
                        extent_to_string(recipe_cloud.extent)));
    }
    add_voxels(bake.size, std::move(field), volume);
    return volume;
}

// Warns (W0215) of a volume in which no column holds cloud.
std::optional<Diagnostic> empty_volume(const Cloud& cloud, const Baked& volume) {
    if (number_named(volume.details, covered_columns).value_or(1) > 0) return std::nullopt;
    const bool has_grown = cloud.shape == config::CloudShape::convection;
    return diagnosis("W0215", fmt::format("`{}` is empty: no voxel holds cloud", volume.name),
                     has_grown
                         ? "let it grow for more minutes, above more, wider or warmer patches"
                         : "raise the coverage, or ask for a share of the sky: cover = \"40 %\"");
}

// Warns (W0230) of a cloud that has grown up to the top of its box. It shows where more than this share of the
// columns with cloud end there.
constexpr double kSeenCut = 0.01;

std::optional<Diagnostic> cut_by_top(const Cloud& cloud, const Baked& volume) {
    const double covered = number_named(volume.details, covered_columns).value_or(0);
    if (cloud.shape != config::CloudShape::convection || covered == 0) return std::nullopt;
    const Level& level = volume.levels.front();
    const VoxelBox top = {{0, 0, level.size[2] - 1}, {level.size[0], level.size[1], 1}};
    std::vector<float> densities(static_cast<std::size_t>(top.count()));
    std::vector<float*> channels(volume.channel_names.size(), nullptr);
    channels.front() = densities.data();
    level.voxels->fill(top, channels);
    const auto cut = std::ranges::count_if(densities, [](float density) { return density > 0; });
    const double share = static_cast<double>(cut) / static_cast<double>(densities.size()) / covered;
    if (share <= kSeenCut) return std::nullopt;
    return diagnosis("W0230",
                     fmt::format("`{}` is cut flat by the top of its box in {:g} % of its columns",
                                 volume.name, to_digits(100 * share, 2)),
                     "raise the last number of its extent, of its cells and of this size", "size");
}

// Replaces the voxels on demand of a volume by voxels in memory, if there is room for them.
void hold_shared(const Cloud& cloud, const CloudVolumeBake& bake, const CloudInputs& inputs,
                 const BakeOptions& options, Baked& volume) {
    auto& voxels = volume.levels.front().voxels;
    const auto held =
        shared_or_made<VoxelSource>(options.intermediates, key_of_voxels(cloud, bake, inputs),
                                    [&]() -> std::shared_ptr<const VoxelSource> {
                                        hold_voxels(options, volume);
                                        return options.cancelled() ? nullptr : voxels;
                                    });
    if (held) voxels = held;
}

// What has grown has its coverage already.
Cloud with_coverage(Cloud cloud, const CloudInputs& inputs) {
    cloud.coverage = inputs.grown ? 1 : inputs.coverage.value_or(cloud.coverage);
    return cloud;
}

}  // namespace

cloud::CloudPlan plan_of_cloud(const Cloud& asked, const CloudInputs& inputs,
                               const std::array<int, 3>& size) {
    const Cloud cloud = with_coverage(asked, inputs);
    return inputs.volume ? make_cloud_plan(cloud, *inputs.volume, inputs.detail, size, inputs.maps)
                         : make_cloud_plan(cloud, *inputs.base, inputs.detail, size, inputs.maps);
}

cloud::CloudReference reference_of_cloud(const Cloud& asked, const CloudInputs& inputs,
                                         const std::array<int, 3>& size) {
    const Cloud cloud = with_coverage(asked, inputs);
    if (inputs.volume) return {cloud, *inputs.volume, inputs.detail, size, inputs.maps};
    return {cloud, *inputs.base, inputs.detail, size, inputs.maps};
}

float filtered_threshold(const Cloud& cloud) {
    const bool in_file = cloud.threshold_at == config::ThresholdAt::bake;
    return in_file ? 0 : static_cast<float>(cloud.threshold);
}

Baked make_cloud_volume(const Cloud& cloud, const CloudVolumeBake& bake, const CloudInputs& inputs,
                        Baked volume) {
    return describe(cloud, bake, inputs, make_field(cloud, bake, inputs), std::move(volume));
}

Baked hold_cloud_volume(const Cloud& cloud, const CloudVolumeBake& bake, const CloudInputs& inputs,
                        const BakeOptions& options, Baked volume) {
    volume = make_cloud_volume(cloud, bake, inputs, std::move(volume));
    hold_shared(cloud, bake, inputs, options, volume);
    return volume;
}

Outcome<Baked> bake_cloud_volume(const Cloud& cloud, const CloudVolumeBake& bake,
                                 const CloudInputs& inputs, const BakeOptions& options,
                                 Baked volume) {
    const auto field = make_field(cloud, bake, inputs);
    volume = describe(cloud, bake, inputs, field, std::move(volume));
    const Intermediates* const shared = options.intermediates;
    if (bake.mips > 1 || (shared && shared->is_shared(key_of_voxels(cloud, bake, inputs)))) {
        hold_shared(cloud, bake, inputs, options, volume);
    } else {
        hold_voxels(options, volume, true);
    }
    if (options.cancelled()) return {};
    volume.seam_error = seam_error_of(*field);
    add_mip_levels(bake.mips, options, volume);
    // Densities are shares of 1, and so is noise; velocities are at most some tens of m/s.
    std::vector<std::array<double, 2>> ranges(volume.channel_names.size(), {0, 1});
    if (field->plan().flow) std::fill(ranges.begin() + 1, ranges.end(), std::array{-50.0, 50.0});
    const auto reference =
        std::make_shared<CloudReference>(reference_of_cloud(cloud, inputs, bake.size));
    Outcome<Baked> finished = finish_volume(
        std::move(volume),
        {.histogram_ranges = ranges,
         .reference =
             [reference](const std::array<double, 3>& place) { return (*reference)(place); },
         .reference_name = "the cloud's definition in double precision, point by point",
         .expensive = reference->is_expensive(),
         .probe_place = [spanned = config::stretched(cloud, bake)](
                            const std::array<double, 3>& uvw,
                            int) { return place_of(spanned, uvw); },
         .covered_above = filtered_threshold(cloud)},
        options);
    if (!finished.value) return finished;
    for (const auto& warning :
         {empty_volume(cloud, *finished.value), cut_by_top(cloud, *finished.value)}) {
        if (warning) finished.diagnostics.push_back(*warning);
    }
    return finished;
}

}  // namespace skybake
