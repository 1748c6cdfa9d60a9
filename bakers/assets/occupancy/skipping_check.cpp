#include "bakers/assets/occupancy/skipping_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "bakers/assets/cloud_volume/cloud_volume.h"
#include "bakers/assets/occupancy/occupancy_check.h"
#include "bakers/io/manifest/asset_files.h"
#include "config/assets/cloud_volume.h"
#include "config/assets/occupancy.h"
#include "config/recipe/recipe.h"
#include "config/sections/named_sections.h"

namespace skybake {

namespace {

using config::OccupancyBake;
using config::OccupancyContent;
using config::Outcome;
using occupancy::CellGrid;
using occupancy::OccupancyCheck;

// What the parameters in an occupancy grid's entry say.
struct Grid {
    OccupancyBake bake;
    float threshold = 0;
};

// None where the entry is not what a bake writes.
std::optional<Grid> grid_of(const ManifestAsset& asset) {
    const auto recipe = config::parse_recipe(asset.parameters, asset.name);
    if (!recipe.value) return std::nullopt;
    const config::Parameters& parameters = recipe.value->parameters;
    const auto own =
        std::find_if(parameters.bakes.begin(), parameters.bakes.end(),
                     [&](const config::Bake& bake) { return bake.name == asset.name; });
    if (own == parameters.bakes.end()) return std::nullopt;
    const auto* bake = own->find<OccupancyBake>();
    if (bake == nullptr || bake->contents.size() != asset.channels.size()) return std::nullopt;
    // A recipe that was read names a cloud volume of a cloud that is there.
    const auto& of = bake_named(parameters, bake->of).as<config::CloudVolumeBake>();
    return Grid{*bake, filtered_threshold(cloud_named(parameters, of.cloud))};
}

const ManifestAsset* asset_named(const Manifest& manifest, const std::string& name) {
    const auto found = std::find_if(manifest.assets.begin(), manifest.assets.end(),
                                    [&](const ManifestAsset& asset) { return asset.name == name; });
    return found != manifest.assets.end() ? &*found : nullptr;
}

// The file of the volume itself.
const ManifestFile* first_file(const ManifestAsset& asset) {
    const auto found = std::find_if(
        asset.files.begin(), asset.files.end(),
        [](const ManifestFile& file) { return file.level == 0 && file.format != "json"; });
    return found != asset.files.end() ? &*found : nullptr;
}

// Which channel tells empty cells from others, the plainest first.
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
        const auto found = std::find(contents.begin(), contents.end(), content);
        if (found == contents.end()) continue;
        return Teller{static_cast<std::size_t>(found - contents.begin()), content};
    }
    return std::nullopt;
}

Outcome<std::vector<std::uint8_t>> occupied_cells(const std::filesystem::path& folder,
                                                  const ManifestAsset& asset,
                                                  const ManifestFile& file, const Grid& grid,
                                                  const Teller& teller) {
    const std::size_t channels = asset.channels.size();
    std::vector<std::uint8_t> occupied;
    Outcome<bool> read = read_asset_file(
        folder / file.path, asset, file, 0,
        [&](std::int64_t, std::int64_t count, const float* values) {
            for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
                const float value = values[i * channels + teller.channel];
                occupied.push_back(teller.is_occupied(value, grid.threshold) ? 1 : 0);
            }
            return true;
        });
    if (!read.value) return {{}, std::move(read.diagnostics)};
    return {std::move(occupied), {}};
}

// What is lost of `volume`, in words; empty: nothing. A file that cannot be read fails elsewhere.
std::string loss_of(const std::filesystem::path& folder, const ManifestAsset& asset,
                    const ManifestAsset& volume, const Grid& grid) {
    const ManifestFile* cells_file = first_file(asset);
    const ManifestFile* voxels_file = first_file(volume);
    const std::optional<Teller> teller = teller_of(grid.bake.contents);
    if (cells_file == nullptr || voxels_file == nullptr || !teller) return "";
    const auto occupied = occupied_cells(folder, asset, *cells_file, grid, *teller);
    if (!occupied.value) return "";
    const CellGrid cells{volume.levels.front().size, grid.bake.cell};
    if (occupied.value->size() != occupancy::count_of(cells.size())) {
        return fmt::format("{} cells do not cover {} at {} voxels per cell", occupied.value->size(),
                           volume.name, grid.bake.cell);
    }
    const auto named = std::find(volume.channels.begin(), volume.channels.end(), grid.bake.channel);
    if (!grid.bake.channel.empty() && named == volume.channels.end()) {
        return fmt::format("{} has no channel {}", volume.name, grid.bake.channel);
    }
    const auto channel =
        grid.bake.channel.empty() ? 0 : static_cast<int>(named - volume.channels.begin());
    OccupancyCheck check(cells, *occupied.value, grid.bake.filter, grid.threshold, channel,
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
        found.lost, found.points, volume.name, grid.threshold, found.worst_value, found.cell[0],
        found.cell[1], found.cell[2]);
}

std::vector<VerifyFailure> check_skipping(const Manifest& manifest,
                                          const std::filesystem::path& folder, int& checks) {
    std::vector<VerifyFailure> failures;
    for (const ManifestAsset& asset : manifest.assets) {
        if (asset.kind != "occupancy" || asset.files.empty()) continue;
        const auto fail = [&](std::string message) {
            failures.push_back({asset.files.front().path, "skipping", std::move(message)});
        };
        const std::optional<Grid> grid = grid_of(asset);
        if (!grid) {
            ++checks;
            fail("its parameters cannot be read as a recipe");
            continue;
        }
        const ManifestAsset* volume = asset_named(manifest, grid->bake.of);
        if (volume == nullptr || !volume->is_volume()) continue;  // baked elsewhere
        ++checks;
        std::string loss = loss_of(folder, asset, *volume, *grid);
        if (!loss.empty()) fail(std::move(loss));
    }
    return failures;
}

}  // namespace

FolderCheck skipping_check() { return {check_skipping}; }

}  // namespace skybake
