// Intermediates that bakes of a cloud's volume, and of assets that are made of it, share in a run.
#include <optional>
#include <vector>

#include "bakers/assets/cloud_volume/cloud_volume.h"
#include "bakers/convection/convection.h"
#include "config/sections/parameters.h"

namespace skybake {
namespace {

// All that voxels depend on.
struct VoxelRequest {
    Cloud cloud;  // with the paths of its maps
    std::optional<Noise> base;
    std::optional<config::VolumeFile> volume;
    std::optional<Noise> detail;
    std::array<int, 3> size{};
    std::optional<double> cover;
    std::optional<PixelType> stored_as;  // decides which columns `cover` counts
    bool operator==(const VoxelRequest&) const = default;
};

struct CoverageRequest {
    VoxelRequest voxels;
    bool operator==(const CoverageRequest&) const = default;
};

template <class Section>
std::optional<Section> copied(const Section* section) {
    return section != nullptr ? std::optional<Section>(*section) : std::nullopt;
}

VoxelRequest request_of(const Cloud& cloud, const CloudVolumeBake& bake, const Noise* base,
                        const config::VolumeFile* volume, const Noise* detail) {
    VoxelRequest request{cloud, copied(base), copied(volume), copied(detail), bake.size, bake.cover,
                         {}};
    if (bake.cover) request.stored_as = bake.pixel_type;
    return request;
}

VoxelRequest request_of(const Parameters& parameters, const CloudVolumeBake& asset) {
    const Cloud& cloud = cloud_named(parameters, asset.cloud);
    const Noise* base = noise_of(parameters, cloud);
    const config::VolumeFile* volume =
        cloud.volume.empty() ? nullptr : &volume_named(parameters, cloud.volume);
    const Noise* detail = cloud.detail.empty() ? nullptr : &noise_named(parameters, cloud.detail);
    return request_of(cloud, asset, base, volume, detail);
}

}  // namespace

NeedKey key_of_voxels(const Cloud& cloud, const CloudVolumeBake& bake, const CloudInputs& inputs) {
    return NeedKey(request_of(cloud, bake, inputs.base, inputs.file, inputs.detail));
}

NeedKey key_of_coverage(const Parameters& parameters, const CloudVolumeBake& bake) {
    return NeedKey(CoverageRequest{request_of(parameters, bake)});
}

std::vector<Need> needs_of_voxels(const Parameters& parameters, const CloudVolumeBake& asset) {
    const VoxelRequest request = request_of(parameters, asset);
    const Cloud& cloud = request.cloud;
    const auto& volume = request.volume;
    const Noise* base = noise_of(parameters, cloud);
    const auto channels = config::cloud_channel_names(base, cloud.channels).size();
    const double seconds = estimate_cloud_volume(parameters, asset).seconds;
    std::vector<Need> needs = {
        {NeedKey(request), "voxels of " + cloud.name, seconds,
         voxels_of(asset.size, 1) * static_cast<double>(channels * sizeof(float)) / kMebibyte}};
    if (asset.cover) {
        needs.push_back(
            {NeedKey(CoverageRequest{request}), "coverage of " + cloud.name, seconds, 0});
    }
    if (volume) {
        // Every voxel is read when a file is opened. What is kept of a tree is 24 bytes for each leaf
        // of 512 voxels; the file may have more of them than the bake has voxels.
        constexpr double kSecondsPerVoxel = 1e-9;
        constexpr double kBytesPerVoxel = 24.0 / 512;
        const double voxels = voxels_of(asset.size, 1);
        needs.push_back({NeedKey(*volume), "opened volume " + volume->name,
                         kSecondsPerVoxel * voxels, kBytesPerVoxel * voxels / kMebibyte});
    }
    if (cloud.shape == config::CloudShape::convection) {
        const convection::Specification wanted = convection::specification_of(cloud);
        needs.push_back({NeedKey(wanted), "growth of " + cloud.name,
                         convection::seconds_to_grow(wanted),
                         convection::bytes_of_grown(wanted) / kMebibyte});
    }
    return needs;
}

}  // namespace skybake
