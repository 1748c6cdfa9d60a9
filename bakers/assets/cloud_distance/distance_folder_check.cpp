#include "bakers/assets/cloud_distance/distance_folder_check.h"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "bakers/assets/cloud_distance/cloud_distance.h"
#include "bakers/assets/cloud_distance/distance_check.h"
#include "bakers/assets/cloud_volume/cloud_volume.h"
#include "bakers/assets/sources/source_files.h"
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
    const float threshold = filtered_threshold(wanted.cloud);
    std::vector<float> distances;
    VoxelBits bits(voxels);
    const auto set_bit = [&](std::int64_t i, float value) {
        if (!(value > threshold)) return;
        const std::int64_t row = i / voxels[0];
        bits.set(static_cast<int>(i % voxels[0]), static_cast<int>(row % voxels[1]),
                 static_cast<int>(row / voxels[1]));
    };
    const bool are_read = read_channel(folder, asset, *file, 0,
                                       [&](std::int64_t, float m) { distances.push_back(m); }) &&
                          read_channel(folder, volume, *voxels_file, *channel, set_bit);
    if (!are_read) return "";
    const occupancy::DistanceCheckResult found = check_distances(
        {texels, distances.data(), wanted.bake.cell}, distance_code(wanted.bake, voxel_m),
        occupancy::NearestVoxel(bits, voxel_m), voxels, voxel_m, kPoints, kRays, {});
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
