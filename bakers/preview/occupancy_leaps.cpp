#include "bakers/preview/occupancy_leaps.h"

#include <algorithm>
#include <cmath>

#include "bakers/occupancy/cell_grid.h"
#include "bakers/occupancy/leap_distance.h"

namespace skybake {
namespace {

using config::OccupancyContent;

// Returns the values of the channel `content` as they were before storing.
std::optional<std::vector<float>> values_of(const PreviewAsset& grid, const OccupancyBake& bake,
                                            OccupancyContent content) {
    const auto found = std::ranges::find(bake.contents, content);
    if (found == bake.contents.end()) return std::nullopt;
    const auto channel = static_cast<std::size_t>(found - bake.contents.begin());
    const bool unorm =
        bake.pixel_type == PixelType::unorm8 || bake.pixel_type == PixelType::unorm16;
    const float scale = content == OccupancyContent::leap && unorm ? 255.0F : 1.0F;
    std::vector<float> values;
    for (std::size_t i = channel; i < grid.voxels.size(); i += bake.contents.size()) {
        values.push_back(grid.voxels[i] * scale);
    }
    return values;
}

std::array<int, 3> size_of(const ManifestAsset& entry) {
    return {entry.size[0], entry.size[1], entry.size[2]};
}

std::vector<float> leaps_of(const std::array<int, 3>& size, std::vector<std::uint8_t> occupied) {
    const auto leaps = occupancy::leap_distance({size, std::move(occupied)});
    return {leaps.begin(), leaps.end()};
}

}  // namespace

std::optional<std::vector<float>> leaps_of_grid(const PreviewAsset& grid, const OccupancyBake& bake,
                                                float threshold) {
    if (!grid.entry.is_volume()) return std::nullopt;
    const std::array<int, 3> size = size_of(grid.entry);
    if (grid.voxels.size() != occupancy::count_of(size) * bake.contents.size()) return std::nullopt;
    if (auto leaps = values_of(grid, bake, OccupancyContent::leap)) {
        for (float& leap : *leaps) leap = std::round(leap);  // a unorm value is a quotient by 255
        return leaps;
    }
    std::vector<std::uint8_t> occupied;
    if (const auto values = values_of(grid, bake, OccupancyContent::occupied)) {
        for (const float value : *values) occupied.push_back(value > 0 ? 1 : 0);
        return leaps_of(size, std::move(occupied));
    }
    if (const auto values = values_of(grid, bake, OccupancyContent::maximum)) {
        for (const float value : *values) occupied.push_back(value > threshold ? 1 : 0);
        return leaps_of(size, std::move(occupied));
    }
    return std::nullopt;
}

std::optional<LeapGrid> leap_grid_of(const PreviewAsset& volume, const PreviewAsset& grid,
                                     const OccupancyBake& bake, float threshold) {
    const bool sees_all = bake.rule == config::OccupancyRule::exact &&
                          bake.filter != config::OccupancyFilter::nearest &&
                          (bake.channel.empty() || bake.channel == volume.entry.channels.front());
    if (!sees_all || bake.of != volume.entry.name || !grid.entry.is_volume()) return std::nullopt;
    const std::array<int, 3> voxels = size_of(volume.entry);
    if (occupancy::CellGrid{voxels, bake.cell}.size() != size_of(grid.entry)) return std::nullopt;
    const auto leaps = leaps_of_grid(grid, bake, threshold);
    if (!leaps) return std::nullopt;
    return leap_grid(voxels, bake.cell, *leaps);
}

}  // namespace skybake
