#include "bakers/assets/estimate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "bakers/assets/named_parameters.h"
#include "bakers/field/pixel_type.h"
#include "bakers/field/voxel_boxes.h"
#include "bakers/light/solver/light_moments.h"
#include "config/sections/cloud_channels.h"

namespace skybake {

namespace {

using config::Bake;
using config::Noise;
using config::Parameters;
using config::VolumeFiles;
using Size = std::array<int, 3>;

constexpr double kMebibyte = 1024.0 * 1024.0;

Estimate estimate_texels(const std::array<int, 2>& size, config::PixelType type,
                         double seconds_per_texel, double certification) {
    Estimate result;
    result.size.assign(size.begin(), size.end());
    const double texels = static_cast<double>(size[0]) * size[1];
    const double bytes_per_texel = type == config::PixelType::half ? 6 : 12;
    result.seconds = texels * seconds_per_texel + certification;
    result.memory_mib = (texels * (24 + 12 + bytes_per_texel) + 8e6) / kMebibyte;
    result.disk_mib = texels * bytes_per_texel / kMebibyte;
    return result;
}

template <class Asset>
Estimate estimate_table(const Asset& asset, double seconds_per_texel, double certification) {
    const std::array<int, 2> size = asset.max_error ? std::array<int, 2>{} : asset.size;
    return estimate_texels(size, asset.pixel_type, seconds_per_texel, certification);
}

// Seconds to store a byte, measured with deflate and without.
double seconds_per_byte(config::VolumeFormat format, const VolumeFiles& files) {
    constexpr double kDeflate = 2e-8;
    constexpr double kCopy = 1e-9;
    if (format == config::VolumeFormat::exr) {
        return files.compression == config::Compression::none ? kCopy : kDeflate;
    }
    const bool deflates =
        format == config::VolumeFormat::vdb && files.vdb_compression == config::VdbCompression::zip;
    return deflates ? kDeflate : kCopy;
}

double octaves_of(const Noise& noise) {
    double octaves = 0;
    for (const config::NoiseChannel& channel : noise.channels) {
        octaves += 1.0 + static_cast<double>(channel.octaves.gains.size() +
                                             channel.worley_octaves.gains.size());
    }
    return octaves;
}

std::size_t channels_of(const Noise& noise) {
    return noise.pack == config::NoisePacking::none ? noise.channels.size() : 1;
}

// Of all levels.
double voxels_of(const Size& size, int levels) {
    double voxels = 0;
    std::array<double, 3> sides = {double(size[0]), double(size[1]), double(size[2])};
    for (int level = 0; level < levels; ++level) {
        voxels += sides[0] * sides[1] * sides[2];
        for (double& side : sides) side = std::max(1.0, std::floor(side / 2));
    }
    return voxels;
}

Estimate estimate_volume(const VolumeFiles& files, const Size& size, std::size_t channels,
                         double seconds_per_voxel) {
    const double voxels = voxels_of(size, files.mips);
    const double bytes = voxels * static_cast<double>(channels) * bytes_per_value(files.pixel_type);
    const auto formats = static_cast<double>(files.formats.size());
    Estimate result;
    result.size.assign(size.begin(), size.end());
    // The voxels are made once to be measured, and again for each file.
    result.seconds = voxels * seconds_per_voxel * (1.0 + formats);
    for (const config::VolumeFormat format : files.formats) {
        result.seconds += bytes * seconds_per_byte(format, files);
    }
    // Boxes on their way, as floats and as the file stores them.
    const BoxSequence boxes(size, static_cast<int>(channels));
    const double values = static_cast<double>(boxes.largest_count()) *
                          static_cast<double>(channels) * std::min(box_slots(0), boxes.count());
    // The libraries of files take as much again to pack them (measured, rounded up), and the
    // program with its modules 64 MiB.
    result.memory_mib = 64 + 2 * values * (4.0 + bytes_per_value(files.pixel_type)) / kMebibyte;
    result.disk_mib = bytes * formats / kMebibyte;
    return result;
}

constexpr double kSecondsPerOctave = 1e-9;  // and voxel
constexpr double kSecondsPerShape = 3e-9;   // profile, threshold, statistics of a voxel

}  // namespace

Estimate estimate_transmittance(const Parameters&, const Bake& bake) {
    return estimate_table(std::get<config::TransmittanceBake>(bake.asset), 2e-7, 0.05);
}

// To solve for the light of all orders, where more than single scattering is asked for.
constexpr double kSecondsToSolve = 2;

double seconds_to_solve(config::SkyOrders orders) {
    return orders == config::SkyOrders::single ? 0 : kSecondsToSolve;
}

Estimate estimate_multiple_scattering(const Parameters&, const Bake& bake) {
    const auto& asset = std::get<config::MultipleScatteringBake>(bake.asset);
    if (asset.method != config::MultipleScatteringMethod::solved) {
        return estimate_table(asset, 1e-4, 0.1);
    }
    const int tables = asset.content == config::MultipleScatteringContent::moments
                           ? moment_count(asset.degree)
                           : 1;
    const std::array<int, 2> size = asset.max_error
                                        ? std::array<int, 2>{}
                                        : std::array<int, 2>{asset.size[0], asset.size[1] * tables};
    return estimate_texels(size, asset.pixel_type, 1e-6, 2 * kSecondsToSolve);
}

Estimate estimate_sky_view(const Parameters&, const Bake& bake) {
    const auto& asset = std::get<config::SkyViewBake>(bake.asset);
    const std::array<int, 2> size = {asset.size[0],
                                     asset.size[1] * static_cast<int>(asset.sun_elevations.size())};
    return estimate_texels(size, asset.pixel_type, 3e-5, 0.3 + seconds_to_solve(asset.orders));
}

Estimate estimate_aerial_perspective(const Parameters&, const Bake& bake) {
    const auto& asset = std::get<config::AerialPerspectiveBake>(bake.asset);
    Estimate result = estimate_volume(asset, asset.size, 4, 1e-5);
    result.seconds += seconds_to_solve(asset.orders);
    // All are held, and their parts (bruneton/parts_memory.h).
    constexpr double kBytesPerVoxel = (4 + 9) * sizeof(float);
    result.memory_mib += voxels_of(asset.size, 1) * kBytesPerVoxel / kMebibyte;
    return result;
}

Estimate estimate_irradiance(const Parameters&, const Bake& bake) {
    const auto& asset = std::get<config::IrradianceBake>(bake.asset);
    return estimate_texels(asset.size, asset.pixel_type, 4e-3,
                           0.3 + seconds_to_solve(asset.orders));
}

Estimate estimate_phase(const Parameters&, const Bake& bake) {
    const auto& asset = std::get<config::PhaseBake>(bake.asset);
    const int width = asset.max_error ? 0 : asset.size;
    return estimate_texels({width, 1}, asset.pixel_type, 1e-6, 1);
}

Estimate estimate_bruneton(const Parameters&, const Bake& bake) {
    const auto& asset = std::get<config::BrunetonBake>(bake.asset);
    const bool has_light = asset.table != config::BrunetonTable::transmittance;
    Estimate result = estimate_volume(asset, asset.size, 4, has_light ? 4e-6 : 2e-7);
    if (has_light) result.seconds += kSecondsToSolve;
    constexpr double kBytesPerVoxel = 4 * sizeof(float);  // all are held
    result.memory_mib += voxels_of(asset.size, 1) * kBytesPerVoxel / kMebibyte;
    return result;
}

Estimate estimate_columns(const Parameters&, const Bake& bake) {
    const auto& asset = std::get<config::OpticalDepthBake>(bake.asset);
    return estimate_volume(asset, asset.size, 4, 1e-6);
}

Estimate estimate_noise_volume(const Parameters& parameters, const Bake& bake) {
    const auto& asset = std::get<config::NoiseVolumeBake>(bake.asset);
    const Noise& noise = noise_named(parameters, asset.noise);
    return estimate_volume(asset, asset.size, channels_of(noise),
                           octaves_of(noise) * kSecondsPerOctave);
}

Estimate estimate_cloud_volume(const Parameters& parameters, const Bake& bake) {
    const auto& asset = std::get<config::CloudVolumeBake>(bake.asset);
    const config::Cloud& cloud = cloud_named(parameters, asset.cloud);
    const Noise& base = noise_named(parameters, cloud.noise);
    double octaves = octaves_of(base);
    if (!cloud.detail.empty()) octaves += octaves_of(noise_named(parameters, cloud.detail));
    return estimate_volume(asset, asset.size,
                           config::cloud_channel_names(base, cloud.channels).size(),
                           octaves * kSecondsPerOctave + kSecondsPerShape);
}

Estimate estimate_occupancy(const Parameters& parameters, const Bake& bake) {
    const auto& asset = std::get<config::OccupancyBake>(bake.asset);
    const Bake& volume = bake_named(parameters, asset.of);
    const Size size = std::get<config::CloudVolumeBake>(volume.asset).size;
    Size cells;
    for (std::size_t i = 0; i < 3; ++i) cells[i] = (size[i] + asset.cell - 1) / asset.cell;
    Estimate result = estimate_volume(asset, cells, asset.contents.size(), 1e-8);
    const Estimate voxels = estimate_cloud_volume(parameters, volume);
    constexpr double kBytesPerCell = 4 + 4 + 1 + 1;  // minimum, maximum, leap, occupied
    result.seconds += voxels.seconds / 2;
    result.memory_mib += voxels.memory_mib + voxels_of(cells, 1) * kBytesPerCell / kMebibyte;
    return result;
}

}  // namespace skybake
