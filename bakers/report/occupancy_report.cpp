#include "bakers/report/occupancy_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "bakers/assets/cloud_volume/cloud_inputs.h"
#include "bakers/assets/occupancy/occupancy_check.h"
#include "bakers/assets/occupancy/occupancy_grid.h"
#include "bakers/field/baked.h"
#include "bakers/field/pixel_type.h"
#include "bakers/math/parallel.h"
#include "bakers/math/transcendental.h"
#include "bakers/occupancy/cell_range.h"
#include "bakers/occupancy/leap_distance.h"
#include "bakers/occupancy/marcher.h"
#include "bakers/report/sweeps/sweep.h"
#include "bakers/report/sweeps/volume_sweep.h"
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

using config::CloudVolumeBake;
using config::OccupancyBake;
using config::Outcome;
using occupancy::CellGrid;
using occupancy::CellRanges;
using occupancy::MarchedVolume;
using occupancy::OccupiedCells;
using occupancy::Skipping;

namespace {

constexpr int kRays = 3000;
constexpr int kQuickRays = 300;
constexpr int kGridRepetitions = 9;
constexpr int kQuickGridRepetitions = 3;
// The tile of Olajos 2016 is 600 units wide, and a ray is 500 units long with steps of 1.
constexpr double kStepsPerTile = 600;
constexpr double kMarchSteps = 500;

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

// One way of skipping: which cells count as occupied, and how rays use them.
struct Structure {
    std::string name;
    Skipping skipping = Skipping::none;
    const OccupiedCells* cells = nullptr;
    const std::vector<std::uint8_t>* leaps = nullptr;
    std::uint64_t bytes = 0;
    double time_ms = 0;
};

class OccupancyMeasurement {
  public:
    OccupancyMeasurement(const std::vector<float>& voxels, const MarchedVolume& volume,
                         const OccupancyBake& bake, const ReportOptions& options)
        : voxels_(voxels), volume_(volume), bake_(bake), options_(options) {}

    // Measures all ways of skipping. Returns nothing after an interruption.
    std::optional<std::vector<SkippingRow>> measure() {
        make_cells();
        const auto cells = exact_.occupied.size();
        const std::uint64_t bits = (cells + 7) / 8;
        const std::vector<Structure> structures = {
            {"no skipping", Skipping::none, &everything_, &no_leaps_, 0, 0},
            {"thesis rule, cell by cell", Skipping::cells, &thesis_, &no_leaps_, bits, thesis_ms_},
            {"exact, cell by cell", Skipping::cells, &exact_, &no_leaps_, bits, exact_ms_},
            {"exact, Chebyshev leaps", Skipping::leaps, &exact_, &leaps_, cells,
             exact_ms_ + leaps_ms_}};
        const auto rays = skipping_rays(volume_.extent, options_.quick ? kQuickRays : kRays);
        std::vector<SkippingRow> rows;
        for (const Structure& structure : structures) {
            if (is_cancelled(options_.progress)) return std::nullopt;
            rows.push_back(row_of(structure, rays));
            if (options_.progress != nullptr) {
                options_.progress->advance("rays", static_cast<double>(rows.size()) /
                                                       static_cast<double>(structures.size()));
            }
        }
        return rows;
    }

    double smallest_safe_share() const { return occupied_share(exact_); }

  private:
    void make_cells() {
        const std::vector<std::function<void()>> jobs = {
            [&] {
                exact_ = occupied_cells(cell_ranges(voxels_.data(), volume_.grid, bake_.filter),
                                        volume_.threshold);
            },
            [&] {
                thesis_ =
                    occupied_cells_as_in_thesis(voxels_.data(), volume_.grid, volume_.threshold);
            },
            [&] { leaps_ = leap_distance(exact_); }};
        const std::vector<double> seconds =
            interleaved_medians(jobs, options_.quick ? kQuickGridRepetitions : kGridRepetitions,
                                [](int, std::size_t) { return true; });
        exact_ms_ = seconds[0] * 1e3;
        thesis_ms_ = seconds[1] * 1e3;
        leaps_ms_ = seconds[2] * 1e3;
        everything_ = exact_;
        std::fill(everything_.occupied.begin(), everything_.occupied.end(), std::uint8_t{1});
    }

    std::int64_t lost_samples(const OccupiedCells& cells, std::int64_t& points) const {
        occupancy::OccupancyCheck check(volume_.grid, cells.occupied, bake_.filter,
                                        volume_.threshold, 0, 1);
        check.add(0, static_cast<std::int64_t>(voxels_.size()), voxels_.data());
        points = check.result().points;
        return check.result().lost;
    }

    SkippingRow row_of(const Structure& structure, const std::array<RaySet, 3>& sets) {
        SkippingRow row;
        row.structure = structure.name;
        row.occupied_share = occupied_share(*structure.cells);
        row.structure_bytes = structure.bytes;
        row.time_ms = structure.time_ms;
        row.lost_samples = lost_samples(*structure.cells, row.samples);
        const double step = volume_.extent[0] / kStepsPerTile;
        for (std::size_t i = 0; i < sets.size(); ++i) {
            const std::vector<occupancy::Ray>& rays = sets[i].rays;
            std::vector<occupancy::MarchResult> results(rays.size());
            parallel_for(static_cast<int>(rays.size()), options_.threads, [&](int ray) {
                const auto at = static_cast<std::size_t>(ray);
                results[at] = march(volume_, rays[at], kMarchSteps * step, step, structure.skipping,
                                    *structure.cells, *structure.leaps);
            });
            double fetches = 0;
            for (const occupancy::MarchResult& result : results) {
                fetches += result.density_fetches + result.structure_fetches;
                depths_.push_back(result.optical_depth);
            }
            row.fetches[i] = fetches / static_cast<double>(rays.size());
        }
        row.changed_rays = changed_rays();
        return row;
    }

    // Returns how many of the rays just marched have another optical depth than without skipping.
    // The first call is for the march without skipping.
    std::int64_t changed_rays() {
        if (unskipped_.empty()) unskipped_ = depths_;
        std::int64_t changed = 0;
        for (std::size_t i = 0; i < depths_.size(); ++i) {
            if (depths_[i] != unskipped_[i]) ++changed;
        }
        depths_.clear();
        return changed;
    }

    const std::vector<float>& voxels_;
    const MarchedVolume& volume_;
    const OccupancyBake& bake_;
    const ReportOptions& options_;
    OccupiedCells exact_;
    OccupiedCells thesis_;
    OccupiedCells everything_;
    std::vector<std::uint8_t> leaps_;
    std::vector<std::uint8_t> no_leaps_;
    double exact_ms_ = 0;
    double thesis_ms_ = 0;
    double leaps_ms_ = 0;
    std::vector<double> depths_;
    std::vector<double> unskipped_;
};

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

}  // namespace

Outcome<AssetReport> report_occupancy(const config::Recipe& recipe, const config::Bake& bake,
                                      const ReportOptions& options) {
    const auto& asset = bake.as<OccupancyBake>();
    auto of = bake_named(recipe.parameters, asset.of).as<CloudVolumeBake>();
    const config::Cloud cloud = config::stretched(cloud_named(recipe.parameters, of.cloud), of);
    Facts details;
    const Outcome<CloudInputs> inputs = cloud_inputs(recipe.parameters, of, details);
    if (!inputs.value) return {{}, inputs.diagnostics};
    const std::array<int, 3> asked = of.size;
    of.size = size_within(asked, max_report_values(options.quick));
    const Baked volume = make_cloud_volume(cloud, of, *inputs.value, {});
    const std::vector<float> voxels =
        stored_channel(volume, channel_named(volume, asset.channel), options.threads);
    const MarchedVolume marched_volume = marched(cloud, voxels, {of.size, asset.cell});

    AssetReport report;
    report.name = bake.name;
    report.kind = "occupancy";
    report.repetitions = options.quick ? kQuickGridRepetitions : kGridRepetitions;
    report.timing = "processor time of the grid from voxels in memory, one thread";
    OccupancyMeasurement measurement(voxels, marched_volume, asset, options);
    auto rows = measurement.measure();
    if (!rows) return {};
    report.skipping = SkippingFacts{of.size, asset.cell, options.quick ? kQuickRays : kRays,
                                    measurement.smallest_safe_share(), std::move(*rows)};
    if (of.size != asked) {
        report.notes.push_back(
            fmt::format("{}: left out, since it has too many voxels to be measured{}; all figures "
                        "are of a smaller volume",
                        size_text(asked), options.quick ? " quickly" : ""));
    }
    return {std::move(report), {}};
}

}  // namespace skybake
