#include "bakers/assets/occupancy/occupancy_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <optional>
#include <string>

#include "bakers/assets/cloud_volume/cloud_volume.h"
#include "bakers/assets/sources/source_files.h"
#include "bakers/io/manifest/asset_files.h"
#include "bakers/math/quadrature.h"
#include "config/assets/cloud_volume.h"
#include "config/assets/occupancy.h"
#include "config/sections/parameters.h"

namespace skybake::occupancy {
namespace {

// The widest filter uses as many planes.
constexpr int kPlanes = 4;

}  // namespace

OccupancyCheck::OccupancyCheck(const CellGrid& grid, const std::vector<std::uint8_t>& occupied,
                               config::OccupancyFilter filter, float threshold, int channel,
                               int channels, int points)
    : grid_(grid),
      cells_(grid.size()),
      occupied_(occupied),
      filter_(filter),
      threshold_(threshold),
      channel_(static_cast<std::size_t>(channel)),
      channels_(static_cast<std::size_t>(channels)),
      planes_(count_of({grid.voxels[0], grid.voxels[1], kPlanes})) {
    assert(occupied.size() == count_of(grid.size()));
    assert(channel >= 0 && channel < channels);
    sort_points(points);
}

std::array<double, 3> OccupancyCheck::place_of(int point) const {
    std::array<double, 3> place = low_discrepancy_point(point);
    for (std::size_t a = 0; a < 3; ++a) place[a] *= grid_.voxels[a];
    return place;
}

std::array<AxisTaps, 3> OccupancyCheck::taps_at(const std::array<double, 3>& place) const {
    std::array<AxisTaps, 3> taps;
    for (std::size_t a = 0; a < 3; ++a) {
        taps[a] = filter_taps(filter_, place[a], grid_.voxels[a], a < 2);
    }
    return taps;
}

// Counts the points of each plane, then puts them in its place.
void OccupancyCheck::sort_points(int points) {
    const auto last_plane = [&](int point) {
        const AxisTaps taps = filter_taps(filter_, place_of(point)[2], grid_.voxels[2], false);
        return static_cast<std::size_t>(taps.voxel[static_cast<std::size_t>(taps.count - 1)]);
    };
    std::vector<std::size_t> next(static_cast<std::size_t>(grid_.voxels[2]) + 1);
    for (int point = 0; point < points; ++point) ++next[last_plane(point) + 1];
    for (std::size_t z = 1; z < next.size(); ++z) next[z] += next[z - 1];
    points_.resize(static_cast<std::size_t>(points));
    for (int point = 0; point < points; ++point) points_[next[last_plane(point)]++] = point;
    ends_ = next;
}

float* OccupancyCheck::plane(int z) {
    return planes_.data() + index_of(grid_.voxels, 0, 0, z % kPlanes);
}

void OccupancyCheck::add(std::int64_t first, std::int64_t count, const float* values) {
    const std::int64_t area = std::int64_t{grid_.voxels[0]} * grid_.voxels[1];
    const std::int64_t end = first + count;
    while (first < end) {
        const auto z = static_cast<int>(first / area);
        const std::int64_t piece = std::min(end, (z + 1) * area) - first;
        float* target = plane(z) + first % area;
        for (std::int64_t i = 0; i < piece; ++i, values += channels_) {
            target[i] = values[channel_];
        }
        first += piece;
        if (first % area == 0) look_at_points(z);
    }
}

void OccupancyCheck::look_at_points(int z) {
    const auto index = static_cast<std::size_t>(z);
    for (std::size_t i = index == 0 ? 0 : ends_[index - 1]; i < ends_[index]; ++i) {
        look_at(points_[i]);
    }
}

void OccupancyCheck::look_at(int point) {
    ++result_.points;
    const std::array<double, 3> place = place_of(point);
    std::array<int, 3> cell{};
    for (std::size_t a = 0; a < 3; ++a) cell[a] = static_cast<int>(place[a]) / grid_.cell;
    if (occupied_[index_of(cells_, cell[0], cell[1], cell[2])] != 0) return;
    const float value = filtered_value(taps_at(place), [&](int x, int y, int z) {
        return plane(z)[index_of(grid_.voxels, x, y, 0)];
    });
    if (!(value > threshold_)) return;
    if (result_.lost++ == 0 || value > result_.worst_value) {
        result_.worst_value = value;
        result_.place = place;
        result_.cell = cell;
    }
}

}  // namespace skybake::occupancy

namespace skybake {
namespace {

using config::OccupancyContent;
using occupancy::CellGrid;
using occupancy::OccupancyCheck;

using Grid = RecordedSource<OccupancyBake>;

// The channel that tells empty cells from others: the plainest one.
struct Teller {
    std::size_t channel = 0;
    OccupancyContent content = OccupancyContent::occupied;

    bool is_occupied(float value, float threshold) const {
        if (content == OccupancyContent::occupied) return value > 0;
        return content == OccupancyContent::leap ? value == 0 : value > threshold;
    }
};

std::optional<Teller> teller_of(const std::vector<OccupancyContent>& contents) {
    for (const OccupancyContent content :
         {OccupancyContent::occupied, OccupancyContent::leap, OccupancyContent::maximum}) {
        const auto found = std::ranges::find(contents, content);
        if (found == contents.end()) continue;
        return Teller{static_cast<std::size_t>(found - contents.begin()), content};
    }
    return std::nullopt;
}

// Returns the loss of `volume`, in words; empty: none. A file that cannot be read fails elsewhere.
std::string loss_of(const std::filesystem::path& folder, const ManifestAsset& asset,
                    const ManifestAsset& volume, const Grid& grid) {
    const ManifestFile* cells_file = first_file(asset);
    const ManifestFile* voxels_file = first_file(volume);
    const std::optional<Teller> teller = teller_of(grid.bake.contents);
    const float threshold = filtered_threshold(grid.cloud);
    if (cells_file == nullptr || voxels_file == nullptr || !teller) return "";
    std::vector<std::uint8_t> occupied;
    const auto tell = [&](std::int64_t, float value) {
        occupied.push_back(teller->is_occupied(value, threshold) ? 1 : 0);
    };
    if (!read_channel(folder, asset, *cells_file, teller->channel, tell)) return "";
    const CellGrid cells{volume.levels.front().size, grid.bake.cell};
    if (occupied.size() != occupancy::count_of(cells.size())) {
        return fmt::format("{} cells do not cover {} at {} voxels per cell", occupied.size(),
                           volume.name, grid.bake.cell);
    }
    const std::optional<std::size_t> channel = channel_in(volume, grid.bake.channel);
    if (!channel) return fmt::format("{} has no channel {}", volume.name, grid.bake.channel);
    OccupancyCheck check(cells, occupied, grid.bake.filter, threshold, static_cast<int>(*channel),
                         static_cast<int>(volume.channels.size()));
    const Outcome<bool> read =
        read_asset_file(folder / voxels_file->path, volume, *voxels_file, 0,
                        [&](std::int64_t first, std::int64_t count, const float* values) {
                            check.add(first, count, values);
                            return true;
                        });
    if (!read.value || check.result().lost == 0) return "";
    const occupancy::OccupancyCheckResult& found = check.result();
    return fmt::format(
        "{} of {} samples of {} are above {} in cells that are marked empty; the largest is {} in "
        "cell ({}, {}, {})",
        found.lost, found.points, volume.name, threshold, found.worst_value, found.cell[0],
        found.cell[1], found.cell[2]);
}

std::vector<VerifyFailure> check_skipping(const Manifest& manifest,
                                          const std::filesystem::path& folder, int& checks) {
    return check_against_volumes(
        manifest, "occupancy", "skipping", checks, recorded_source<OccupancyBake>,
        [&](const ManifestAsset& asset, const ManifestAsset& volume, const Grid& wanted) {
            return loss_of(folder, asset, volume, wanted);
        });
}

}  // namespace

FolderCheck skipping_check() { return {check_skipping}; }

}  // namespace skybake
