#include "bakers/assets/occupancy/occupancy_grid.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "bakers/assets/description/asset_label.h"
#include "bakers/assets/occupancy/occupancy_proof.h"
#include "bakers/assets/sources/source_volume.h"
#include "bakers/field/baked.h"
#include "bakers/field/finish_volume.h"
#include "bakers/math/bake_clock.h"
#include "bakers/occupancy/cloud_bits.h"
#include "bakers/occupancy/occupied_cells.h"
#include "config/text/mapped.h"

namespace skybake {
namespace {

using config::OccupancyContent;
using config::OccupancyRule;
using occupancy::CellGrid;
using occupancy::CellRanges;
using occupancy::CellSource;
using occupancy::ChannelSource;
using occupancy::OccupiedCells;
using occupancy::SkippingGain;

constexpr double kFarthestLeap = 255;

std::vector<std::string> grid_names(const std::vector<OccupancyContent>& contents) {
    return mapped<std::string>(contents, [](OccupancyContent content) {
        return word_of("occupancy", "contents", content);
    });
}

std::string content_of(const OccupancyBake& bake) {
    return fmt::format(
        "cells of {} voxels: {} (occupied: 1 or 0; leap: Chebyshev distance in cells to the "
        "nearest occupied one{}; minimum, maximum: of lookups within the cell)",
        bake.cell, fmt::join(grid_names(bake.contents), ", "),
        occupancy::is_unorm(bake.pixel_type) ? ", over 255" : "");
}

// The nearest place to texture coordinates that is a quarter of a cell from its middle along each
// axis: near enough for no rounding to reach the next cell, and off the middle, so that linear
// lookups differ.
ProbePlace place_of(const Baked& of, int cell, const std::array<double, 3>& uvw) {
    const CellGrid grid{of.levels.front().size, cell};
    const std::array<int, 3> cells = grid.size();
    ProbePlace place{{}, {{}}};
    for (std::size_t i = 0; i < 3; ++i) {
        const double position = std::clamp(uvw[i], 0.0, 1.0) * cells[i];
        const int k = std::min(static_cast<int>(position), cells[i] - 1);
        const occupancy::Span voxels = grid.voxels_of(i, k);
        const double part = position - k < 0.5 ? 0.25 : 0.75;
        const double voxel = voxels.first + part * voxels.count();
        place.at.emplace_back(of.axes[i].quantity, of.axes[i].first + voxel * of.voxel_size_m[i]);
        place.lookups.front().uvw[i] = voxel / (static_cast<double>(cell) * cells[i]);
    }
    return place;
}

// Cells that are empty by `rule` and not by the exact one.
std::size_t unsafe_cells(const OccupiedCells& rule, const OccupiedCells& exact) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < exact.occupied.size(); ++i) {
        if (exact.occupied[i] > rule.occupied[i]) ++count;
    }
    return count;
}

Diagnostic lost_cell(const Baked& volume, const occupancy::LostCell& lost) {
    return diagnosis(
        "E0405",
        fmt::format("`{}`: cell ({}, {}, {}) is marked empty, but a lookup in it reaches {}",
                    volume.name, lost.cell[0], lost.cell[1], lost.cell[2], lost.value));
}

// What leaps save a march, if there are any and it is to be found.
std::optional<SkippingGain> gain_of(const OccupiedVolume& of, const CellSource& cells,
                                    const OccupancyBake& bake, const BakeOptions& options) {
    if (cells.leaps().empty() || options.certification == Certification::off) return std::nullopt;
    const BakeTime time(BakePart::certificate);
    const occupancy::LeapCells leaps{{of.volume.levels.front().size, bake.cell}, cells.leaps()};
    const occupancy::VoxelBits bits =
        voxel_bits(channel_of(of, bake.channel), leaps.grid, of.threshold, options);
    return skipping_gain(bits, of.volume.voxel_size_m, bake.filter, leaps, options);
}

// The grid of level 0, with what is known of it among the volume's details. No value after an
// interruption, or with a diagnostic.
Outcome<std::shared_ptr<const CellSource>> make_cells(const OccupiedVolume& of,
                                                      const OccupancyBake& bake,
                                                      const CellGrid& grid,
                                                      const BakeOptions& options, Baked& volume) {
    Outcome<std::shared_ptr<const CellSource>> outcome;
    const ChannelSource source = channel_of(of, bake.channel);
    const float threshold = of.threshold;
    CellRanges ranges = cell_ranges(source, grid, bake.filter, options);
    if (options.cancelled()) return outcome;
    const OccupiedCells exact = occupied_cells(ranges, threshold);
    OccupiedCells occupied = exact;
    if (bake.rule == OccupancyRule::thesis) {
        occupied = occupied_cells_as_in_thesis(source, grid, threshold, options);
        volume.details.emplace_back("unsafe_cells",
                                    static_cast<double>(unsafe_cells(occupied, exact)));
    }
    volume.details.emplace_back("occupied_share", occupied_share(occupied));
    volume.details.emplace_back("smallest_safe_share", occupied_share(exact));
    const auto cells = std::make_shared<const CellSource>(std::move(ranges), std::move(occupied),
                                                          bake.contents, bake.pixel_type);
    if (bake.rule == OccupancyRule::exact) {
        const auto lost = find_lost_cell(source, grid, bake.filter, exact, threshold, options);
        if (lost) outcome.diagnostics.push_back(lost_cell(volume, *lost));
    }
    if (!options.cancelled() && outcome.diagnostics.empty()) outcome.value = cells;
    return outcome;
}

void add_levels(std::shared_ptr<const CellSource> cells, const OccupancyBake& bake, Baked& volume) {
    for (int level = 0; level < bake.mips; ++level) {
        add_voxels(cells->ranges().size, cells, volume);
        if (level + 1 == bake.mips) return;
        cells = std::make_shared<const CellSource>(next_level(cells->ranges()),
                                                   next_level(cells->occupied()), bake.contents,
                                                   bake.pixel_type);
    }
}

std::vector<std::array<double, 2>> histogram_ranges(const OccupancyBake& bake) {
    const bool half_or_float =
        bake.pixel_type == PixelType::half || bake.pixel_type == PixelType::float32;
    std::vector<std::array<double, 2>> ranges;
    for (const OccupancyContent content : bake.contents) {
        const bool in_cells = content == OccupancyContent::leap && half_or_float;
        ranges.push_back({0, in_cells ? kFarthestLeap : 1});
    }
    return ranges;
}

}  // namespace

std::size_t channel_named(const Baked& volume, const std::string& name) {
    const auto found = std::ranges::find(volume.channel_names, name);
    return name.empty() ? 0 : static_cast<std::size_t>(found - volume.channel_names.begin());
}

ChannelSource channel_of(const OccupiedVolume& of, const std::string& name) {
    return {*of.volume.levels.front().voxels, static_cast<int>(channel_named(of.volume, name)),
            static_cast<int>(of.volume.channel_names.size()), of.volume.pixel_type};
}

std::optional<Diagnostic> add_skipping_gain(const SkippingGain& gain, Baked& volume) {
    volume.details.emplace_back(fetches_without, to_digits(gain.without, 3));
    volume.details.emplace_back(fetches_with, to_digits(gain.with, 3));
    if (gain.with <= most_fetches * gain.without) return std::nullopt;
    return diagnosis(
        "W0227",
        fmt::format("`{}` is not worth its fetches: a ray takes {:.3g} with it, and {:.3g} without",
                    volume.name, gain.with, gain.without),
        "march this cloud without it, or with smaller cells", "cell");
}

Outcome<Baked> bake_occupancy(const OccupiedVolume& of, const OccupancyBake& bake,
                              const BakeOptions& options, Baked volume) {
    const CellGrid grid{of.volume.levels.front().size, bake.cell};
    volume.kind = "occupancy";
    volume.content = content_of(bake);
    place_blocks(of.volume, grid,
                 {"cell",
                  fmt::format("cell k has voxels {} k to {} k + {}, look up nearest", bake.cell,
                              bake.cell, bake.cell - 1),
                  AxisFilter::nearest},
                 volume);
    volume.channel_names = names_of_channels(bake.contents.size());
    volume.grid_names = grid_names(bake.contents);
    set_files(bake, volume);
    volume.details.insert(
        volume.details.end(),
        {{"of", bake.of},
         {"channel", of.volume.channel_names[channel_named(of.volume, bake.channel)]},
         {"cell", static_cast<double>(bake.cell)},
         {"filter", word_of("occupancy", "filter", bake.filter)},
         {"rule", word_of("occupancy", "rule", bake.rule)},
         {"threshold", to_shortest(of.threshold)}});
    const auto leap = std::ranges::find(bake.contents, OccupancyContent::leap);
    if (leap != bake.contents.end()) {
        volume.details.emplace_back("leap_scale",
                                    occupancy::is_unorm(bake.pixel_type) ? kFarthestLeap : 1.0);
    }

    auto cells = make_cells(of, bake, grid, options, volume);
    if (!cells.value) return {{}, std::move(cells.diagnostics)};
    std::optional<Diagnostic> warning;
    if (const auto gain = gain_of(of, **cells.value, bake, options)) {
        warning = add_skipping_gain(*gain, volume);
    }
    add_levels(*cells.value, bake, volume);
    VolumeFinish finish;
    finish.histogram_ranges = histogram_ranges(bake);
    finish.probe_place = [&of, &bake](const std::array<double, 3>& uvw, int level) {
        return place_of(of.volume, bake.cell << level, uvw);
    };
    Outcome<Baked> finished = finish_volume(std::move(volume), finish, options);
    if (finished.value && warning) finished.diagnostics.push_back(*warning);
    return finished;
}

}  // namespace skybake
