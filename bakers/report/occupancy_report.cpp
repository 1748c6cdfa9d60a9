#include "bakers/report/occupancy_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bakers/assets/cloud_volume/cloud_inputs.h"
#include "bakers/assets/occupancy/occupancy_grid.h"
#include "bakers/field/baked.h"
#include "bakers/field/pixel_type.h"
#include "bakers/math/parallel.h"
#include "bakers/math/transcendental.h"
#include "bakers/occupancy/marcher.h"
#include "bakers/report/measured_distance.h"
#include "bakers/report/measurement.h"
#include "bakers/report/skipping_measurement.h"
#include "config/assets/cloud_distance.h"
#include "config/assets/cloud_volume.h"
#include "config/assets/occupancy.h"
#include "config/sections/parameters.h"

namespace skybake {

// --- Rays ----------------------------------------------------------------------------------------

namespace {

using occupancy::Ray;
using Member = std::array<double, 5>;

// Returns member n of Roberts' sequence: fraction(1/2 + n / g^i), where g is the real root of g^6 =
// g + 1 (M. Roberts, "The unreasonable effectiveness of quasirandom sequences", 2018).
Member member(int n) {
    constexpr double kRoot = 1.1347241384015194;
    Member values;
    double power = 1;
    for (double& value : values) {
        power *= kRoot;
        const double sum = 0.5 + n / power;
        value = sum - std::floor(sum);
    }
    return values;
}

std::array<double, 3> direction(double cosine, double turn) {
    const double sine = std::sqrt(std::max(0.0, (1 - cosine) * (1 + cosine)));
    return {sine * cosine_of_turns(turn), sine * cosine_of_turns(turn - 0.25), cosine};
}

// Maps a uniform share to a cosine that is uniform from cos 60 deg to 1.
double steep_cosine(double share) {
    constexpr double kLeast = 0.5;
    return kLeast + (1 - kLeast) * share;
}

}  // namespace

std::array<RaySet, 3> skipping_rays(const std::array<double, 3>& extent, int count) {
    constexpr double kLayer = 0.25;
    std::array<RaySet, 3> sets = {{{"up", {}}, {"within", {}}, {"down", {}}}};
    for (int n = 1; n <= count; ++n) {
        const auto [x, y, cosine, turn, z] = member(n);
        const std::array<double, 3> base = {x * extent[0], y * extent[1], 0};
        std::array<double, 3> layer = base;
        layer[2] = z * kLayer * extent[2];
        std::array<double, 3> top = base;
        top[2] = extent[2];
        const double steep = steep_cosine(cosine);
        sets[0].rays.push_back({base, direction(steep, turn)});
        sets[1].rays.push_back({layer, direction(2 * cosine - 1, turn)});
        sets[2].rays.push_back({top, direction(-steep, turn)});
    }
    return sets;
}

// --- The report ----------------------------------------------------------------------------------

using config::CloudDistanceBake;
using config::CloudVolumeBake;
using config::OccupancyBake;
using config::Outcome;
using occupancy::CellGrid;
using occupancy::MarchedVolume;

namespace {

// Returns the values of one channel as stored.
std::vector<float> stored_channel(const Baked& volume, std::size_t channel, int threads) {
    const Level& level = volume.levels.front();
    std::vector<float> values(static_cast<std::size_t>(VoxelBox{{}, level.size}.count()));
    const BoxSequence boxes(level.size, 1);
    parallel_for(boxes.count(), threads, [&](int i) {
        const VoxelBox box = boxes[i];
        // The sequence has one column, so the boxes follow each other in the order of the voxels.
        float* const target =
            values.data() + occupancy::index_of(level.size, 0, box.origin[1], box.origin[2]);
        std::vector<float*> channels(volume.channel_names.size(), nullptr);
        channels[channel] = target;
        level.voxels->fill(box, channels);
        round_values(target, static_cast<std::size_t>(box.count()), volume.pixel_type);
    });
    return values;
}

// The largest volumes that are held in memory for this.
constexpr std::int64_t kMostVoxels = std::int64_t{1} << 26;
constexpr std::int64_t kQuickVoxels = std::int64_t{1} << 23;

MarchedVolume marched(const config::Cloud& cloud, const std::vector<float>& voxels,
                      const CellGrid& grid) {
    MarchedVolume volume;
    volume.voxels = voxels.data();
    volume.grid = grid;
    for (std::size_t i = 0; i < 3; ++i) volume.extent[i] = cloud.extent[i].meters;
    volume.threshold = filtered_threshold(cloud);
    volume.has_edge = cloud.threshold_at == config::ThresholdAt::runtime;
    volume.edge_softness = cloud.edge_softness;
    return volume;
}

// The distances of a smaller volume, whose texels tile it.
CloudDistanceBake tiling(CloudDistanceBake bake, const std::array<int, 3>& size) {
    while (size[0] % bake.cell != 0 || size[1] % bake.cell != 0) bake.cell /= 2;
    return bake;
}

// Measures the grid of `asset`, and distances if there are some.
Outcome<AssetReport> report_of(const config::Recipe& recipe, AssetReport report,
                               const OccupancyBake& asset, const CloudDistanceBake* distance,
                               const ReportOptions& options) {
    auto of = bake_named(recipe.parameters, asset.of).as<CloudVolumeBake>();
    const config::Cloud cloud = config::stretched(cloud_named(recipe.parameters, of.cloud), of);
    Facts details;
    const Outcome<CloudInputs> inputs = cloud_inputs(recipe.parameters, of, details);
    if (!inputs.value) return {{}, inputs.diagnostics};
    const std::array<int, 3> asked = of.size;
    of.size = size_within(asked, options.quick ? kQuickVoxels : kMostVoxels);
    const Baked volume = make_cloud_volume(cloud, of, *inputs.value, {});
    const std::vector<float> voxels =
        stored_channel(volume, channel_named(volume, asset.channel), options.threads);
    std::optional<CloudDistanceBake> texels;
    if (distance != nullptr) texels = tiling(*distance, of.size);
    const MarchedVolume marched_volume =
        marched(cloud, voxels, {of.size, texels ? texels->cell : asset.cell});
    std::optional<MeasuredDistance> distances;
    if (texels) distances.emplace(voxels, marched_volume, *texels);
    report.repetitions = grid_repetitions(options);
    report.timing = "processor time of the grid from voxels in memory, one thread";
    report.skipping =
        measure_skipping(voxels, marched_volume, asset, distances ? &*distances : nullptr, options);
    if (!report.skipping) return {};
    if (of.size != asked) {
        report.notes.push_back(
            fmt::format("{}: left out, since it has too many voxels to be measured{}; all figures "
                        "are of a smaller volume",
                        size_text(asked), options.quick ? " quickly" : ""));
    }
    return {std::move(report), {}};
}

AssetReport report_named(const std::string& name, const char* kind) {
    AssetReport report;
    report.name = name;
    report.kind = kind;
    return report;
}

}  // namespace

Outcome<AssetReport> report_occupancy(const config::Recipe& recipe, const config::Bake& bake,
                                      const ReportOptions& options) {
    return report_of(recipe, report_named(bake.name, "occupancy"), bake.as<OccupancyBake>(),
                     nullptr, options);
}

Outcome<AssetReport> report_cloud_distance(const config::Recipe& recipe, const config::Bake& bake,
                                           const ReportOptions& options) {
    const auto& asset = bake.as<CloudDistanceBake>();
    OccupancyBake cells;
    cells.of = asset.of;
    cells.channel = asset.channel;
    cells.cell = asset.cell;
    return report_of(recipe, report_named(bake.name, "cloud_distance"), cells, &asset, options);
}

}  // namespace skybake
