#include "bakers/assets/cloud_distance/distance_folder_check.h"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bakers/assets/cloud_distance/cloud_distance.h"
#include "bakers/assets/cloud_distance/distance_check.h"
#include "bakers/assets/cloud_volume/cloud_volume.h"
#include "bakers/assets/sources/source_files.h"
#include "bakers/io/manifest/asset_files.h"
#include "bakers/occupancy/cloud_bits.h"
#include "config/assets/cloud_distance.h"
#include "config/assets/cloud_volume.h"
#include "config/sections/parameters.h"

namespace skybake {
namespace {

using config::CloudDistanceBake;
using occupancy::VoxelBits;

constexpr int kPoints = 65536;
constexpr int kRays = 10000;

using Distances = RecordedSource<CloudDistanceBake>;

// The first channel of a file; nothing where it cannot be read, which fails elsewhere.
std::optional<std::vector<float>> stored_distances(const std::filesystem::path& folder,
                                                   const ManifestAsset& asset,
                                                   const ManifestFile& file) {
    const std::size_t channels = asset.channels.size();
    std::vector<float> distances;
    const auto read = read_asset_file(folder / file.path, asset, file, 0,
                                      [&](std::int64_t, std::int64_t count, const float* values) {
                                          for (std::int64_t i = 0; i < count; ++i) {
                                              distances.push_back(*values);
                                              values += channels;
                                          }
                                          return true;
                                      });
    return read.value ? std::optional(std::move(distances)) : std::nullopt;
}

std::optional<VoxelBits> stored_bits(const std::filesystem::path& folder,
                                     const ManifestAsset& volume, const ManifestFile& file,
                                     std::size_t channel, float threshold) {
    const std::array<int, 3>& size = volume.levels.front().size;
    VoxelBits bits(size);
    const auto read = read_asset_file(
        folder / file.path, volume, file, 0,
        [&](std::int64_t first, std::int64_t count, const float* values) {
            for (std::int64_t i = first; i < first + count; ++i) {
                if (values[channel] > threshold) {
                    const std::int64_t row = i / size[0];
                    bits.set(static_cast<int>(i % size[0]), static_cast<int>(row % size[1]),
                             static_cast<int>(row / size[1]));
                }
                values += volume.channels.size();
            }
            return true;
        });
    return read.value ? std::optional(std::move(bits)) : std::nullopt;
}

// Returns the fault of the distances to `volume`, in words; empty: none.
std::string fault_of(const std::filesystem::path& folder, const ManifestAsset& asset,
                     const ManifestAsset& volume, const Distances& wanted) {
    const ManifestFile* file = first_file(asset);
    const ManifestFile* voxels_file = first_file(volume);
    if (file == nullptr || voxels_file == nullptr) return "";
    const std::optional<std::size_t> channel = channel_in(volume, wanted.bake.channel);
    if (!channel) return fmt::format("{} has no channel {}", volume.name, wanted.bake.channel);
    const std::array<int, 3>& voxels = wanted.of.size;
    const std::array<int, 3> texels = occupancy::CellGrid{voxels, wanted.bake.cell}.size();
    if (volume.levels.front().size != voxels || asset.levels.front().size != texels) {
        return fmt::format("its texels do not cover {} at {} voxels per texel", volume.name,
                           wanted.bake.cell);
    }
    const std::array<double, 3> voxel_m = config::voxel_edges(wanted.cloud, wanted.of);
    const auto distances = stored_distances(folder, asset, *file);
    const auto bits =
        stored_bits(folder, volume, *voxels_file, *channel, filtered_threshold(wanted.cloud));
    if (!distances || !bits) return "";
    const occupancy::DistanceCheckResult found = check_distances(
        {texels, distances->data(), wanted.bake.cell}, distance_code(wanted.bake, voxel_m),
        occupancy::NearestVoxel(*bits, voxel_m), voxels, voxel_m, kPoints, kRays, {});
    if (!found.failed()) return "";
    return fmt::format(
        "of {} distances to {}, {} are too far and {} are nearer than they need be, by up to "
        "{:.3g} m at voxel ({:.1f}, {:.1f}, {:.1f}); {} of {} steps of rays are lost",
        found.points, volume.name, found.too_far, found.too_near, found.worst_m,
        found.worst_place[0], found.worst_place[1], found.worst_place[2], found.lost_steps,
        found.steps);
}

std::vector<VerifyFailure> check_folder(const Manifest& manifest,
                                        const std::filesystem::path& folder, int& checks) {
    return check_against_volumes(
        manifest, "cloud_distance", "distance", checks, recorded_source<CloudDistanceBake>,
        [&](const ManifestAsset& asset, const ManifestAsset& volume, const Distances& wanted) {
            return fault_of(folder, asset, volume, wanted);
        });
}

}  // namespace

FolderCheck distance_folder_check() { return {check_folder}; }

}  // namespace skybake
