#include "bakers/report/skipping_measurement.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>

#include "bakers/assets/occupancy/occupancy_check.h"
#include "bakers/math/parallel.h"
#include "bakers/occupancy/cell_range.h"
#include "bakers/occupancy/leap_distance.h"
#include "bakers/occupancy/occupied_cells.h"
#include "bakers/report/measurement.h"
#include "bakers/report/occupancy_report.h"

namespace skybake {

namespace {

using config::OccupancyBake;
using occupancy::MarchedVolume;
using occupancy::OccupiedCells;
using occupancy::Skipping;

constexpr int kRays = 3000;
constexpr int kQuickRays = 300;
constexpr int kGridRepetitions = 9;
constexpr int kQuickGridRepetitions = 3;
constexpr int kDistances = 65536;
constexpr int kQuickDistances = 4096;
// The tile of Olajos 2016 is 600 units wide, and a ray is 500 units long with steps of 1.
constexpr double kStepsPerTile = 600;
constexpr double kMarchSteps = 500;

// One way of skipping: which cells count as occupied, and how rays use them; or distances, and no
// cells.
struct Structure {
    std::string name;
    Skipping skipping = Skipping::none;
    const OccupiedCells* cells = nullptr;
    const std::vector<std::uint8_t>* leaps = nullptr;
    std::uint64_t bytes = 0;
    double time_ms = 0;
    occupancy::DistanceLookup distance = {};
};

class SkippingMeasurement {
  public:
    SkippingMeasurement(const std::vector<float>& voxels, const MarchedVolume& volume,
                        const OccupancyBake& bake, MeasuredDistance* distance,
                        const ReportOptions& options)
        : voxels_(voxels), volume_(volume), bake_(bake), distance_(distance), options_(options) {}

    // Measures all ways of skipping. Returns nothing after an interruption.
    std::optional<std::vector<SkippingRow>> measure() {
        make_cells();
        const auto cells = exact_.occupied.size();
        const std::uint64_t bits = (cells + 7) / 8;
        std::vector<Structure> structures = {
            {"no skipping", Skipping::none, &everything_, &no_leaps_, 0, 0},
            {"thesis rule, cell by cell", Skipping::cells, &thesis_, &no_leaps_, bits, thesis_ms_},
            {"exact, cell by cell", Skipping::cells, &exact_, &no_leaps_, bits, exact_ms_},
            {"exact, Chebyshev leaps", Skipping::leaps, &exact_, &leaps_, cells,
             exact_ms_ + leaps_ms_}};
        if (distance_ != nullptr) {
            Structure distances{"distances, traced in spheres"};
            distances.bytes = distance_->bytes();
            distances.time_ms = distance_ms_;
            distances.distance = distance_->lookup();
            structures.push_back(std::move(distances));
        }
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
        std::vector<std::function<void()>> jobs = {
            [&] {
                exact_ = occupied_cells(cell_ranges(voxels_.data(), volume_.grid, bake_.filter),
                                        volume_.threshold);
            },
            [&] {
                thesis_ =
                    occupied_cells_as_in_thesis(voxels_.data(), volume_.grid, volume_.threshold);
            },
            [&] { leaps_ = leap_distance(exact_); }};
        if (distance_ != nullptr) jobs.emplace_back([&] { distance_->make(); });
        const std::vector<double> seconds = interleaved_medians(
            jobs, grid_repetitions(options_), [](int, std::size_t) { return true; });
        exact_ms_ = seconds[0] * 1e3;
        thesis_ms_ = seconds[1] * 1e3;
        leaps_ms_ = seconds[2] * 1e3;
        if (distance_ != nullptr) distance_ms_ = seconds[3] * 1e3;
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
        row.structure_bytes = structure.bytes;
        row.time_ms = structure.time_ms;
        if (structure.distance) {
            const auto found = distance_->check(options_.quick ? kQuickDistances : kDistances);
            row.occupied_share = distance_->surface_share();
            row.samples = found.points;
            row.lost_samples = found.too_far;
        } else {
            row.occupied_share = occupied_share(*structure.cells);
            row.lost_samples = lost_samples(*structure.cells, row.samples);
        }
        const double step = volume_.extent[0] / kStepsPerTile;
        for (std::size_t i = 0; i < sets.size(); ++i) {
            const std::vector<occupancy::Ray>& rays = sets[i].rays;
            std::vector<occupancy::MarchResult> results(rays.size());
            parallel_for(static_cast<int>(rays.size()), options_.threads, [&](int ray) {
                const auto at = static_cast<std::size_t>(ray);
                const double length = kMarchSteps * step;
                results[at] =
                    structure.distance
                        ? march_by_distance(volume_, rays[at], length, step, structure.distance)
                        : march(volume_, rays[at], length, step, structure.skipping,
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
    MeasuredDistance* distance_;
    const ReportOptions& options_;
    OccupiedCells exact_;
    OccupiedCells thesis_;
    OccupiedCells everything_;
    std::vector<std::uint8_t> leaps_;
    std::vector<std::uint8_t> no_leaps_;
    double exact_ms_ = 0;
    double thesis_ms_ = 0;
    double leaps_ms_ = 0;
    double distance_ms_ = 0;
    std::vector<double> depths_;
    std::vector<double> unskipped_;
};

}  // namespace

int grid_repetitions(const ReportOptions& options) {
    return options.quick ? kQuickGridRepetitions : kGridRepetitions;
}

std::optional<SkippingFacts> measure_skipping(const std::vector<float>& voxels,
                                              const MarchedVolume& volume,
                                              const OccupancyBake& bake, MeasuredDistance* distance,
                                              const ReportOptions& options) {
    SkippingMeasurement measurement(voxels, volume, bake, distance, options);
    auto rows = measurement.measure();
    if (!rows) return std::nullopt;
    return SkippingFacts{volume.grid.voxels, volume.grid.cell, options.quick ? kQuickRays : kRays,
                         measurement.smallest_safe_share(), std::move(*rows)};
}

}  // namespace skybake
