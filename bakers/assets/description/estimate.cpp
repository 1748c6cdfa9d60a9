#include "bakers/assets/description/estimate.h"

#include <algorithm>
#include <cmath>

#include "bakers/field/baked.h"
#include "bakers/field/pixel_type.h"
#include "bakers/field/smallest_table.h"
#include "config/sections/noise.h"

namespace skybake {

using config::AssetFiles;
using Size = std::array<int, 3>;

namespace {

// Seconds to store a byte, measured with deflate, with the faster one of EXR files, and without.
double seconds_per_byte(config::FileFormat format, const AssetFiles& files) {
    constexpr double kDeflate = 2e-8;
    constexpr double kExrDeflate = 7e-9;
    constexpr double kCopy = 1e-9;
    if (format == config::FileFormat::exr) {
        if (files.compression == config::Compression::none) return kCopy;
        return files.compression == config::Compression::piz ? kDeflate : kExrDeflate;
    }
    const bool deflates = config::facts_of(format).deflates ||
                          (format == config::FileFormat::vdb &&
                           files.vdb_compression == config::VdbCompression::zip) ||
                          (format == config::FileFormat::ktx2 &&
                           files.ktx2_compression == config::Ktx2Compression::zstd);
    return deflates ? kDeflate : kCopy;
}

}  // namespace

double seconds_to_solve(config::SkyOrders orders) {
    return orders == config::SkyOrders::single ? 0 : kSecondsToSolve;
}

double octaves_of(const Noise& noise) {
    // Octaves whose voxels share no lattice points cost as much as this many that do: ratios of
    // median times of noise_benchmark.
    constexpr double kScatteredGradients = 32;
    constexpr double kScatteredCells = 120;
    constexpr double kAlligator = 4;  // where cells are several voxels wide
    constexpr double kWarpComponents = 3;
    const auto count = [](const NoiseOctaves& octaves) {
        return static_cast<double>(octaves.gains.size());
    };
    double octaves = 0;
    for (const NoiseChannel& channel : noise.channels) {
        const bool warped = channel.warp_strength != 0;
        const bool alligator = config::is_alligator(channel.type);
        const bool of_cells = alligator || channel.type == NoiseType::worley;
        const double gradients = warped ? kScatteredGradients : 1;
        const double cells = warped ? kScatteredCells : alligator ? kAlligator : 1;
        octaves += 1 + count(channel.octaves) * (of_cells ? cells : gradients) +
                   count(channel.worley_octaves) * cells +
                   count(channel.warp_octaves) * kWarpComponents;
    }
    return octaves;
}

double voxels_of(const Size& size, int levels) {
    double voxels = 0;
    std::array<double, 3> sides = {double(size[0]), double(size[1]), double(size[2])};
    for (int level = 0; level < levels; ++level) {
        voxels += sides[0] * sides[1] * sides[2];
        for (double& side : sides) side = std::max(1.0, std::floor(side / 2));
    }
    return voxels;
}

Estimate estimate_texels(const AssetFiles& files, const std::array<int, 2>& size,
                         std::size_t channels, double seconds_per_texel, double certification) {
    Estimate result;
    result.size.assign(size.begin(), size.end());
    const double texels = static_cast<double>(size[0]) * size[1];
    const auto held_channels = static_cast<double>(std::min<std::size_t>(channels, 4));
    const auto stored_bytes = [&](const std::array<int, 2>& sides) {
        return voxels_of({sides[0], sides[1], 1}, files.mips) * held_channels *
               static_cast<double>(bytes_per_value(files.pixel_type));
    };
    result.seconds = texels * seconds_per_texel + certification;
    // Texels are in memory as computed, as stored, and once more while a file is written.
    const std::array<int, 2> held = texels > 0 ? size : largest_table(size[1] == 1);
    const double values = static_cast<double>(held[0]) * held[1] * held_channels;
    result.memory_mib =
        (values * (sizeof(double) + sizeof(float)) + stored_bytes(held)) / kMebibyte;
    result.disk_mib = stored_bytes(size) * static_cast<double>(files.formats.size()) / kMebibyte;
    return result;
}

Estimate estimate_volume(const AssetFiles& files, const Size& size, std::size_t channels,
                         double seconds_per_voxel) {
    const double voxels = voxels_of(size, files.mips);
    const double bytes =
        voxels * static_cast<double>(channels) * bits_per_value(files.pixel_type) / 8;
    const auto formats = static_cast<double>(files.formats.size());
    Estimate result;
    result.size.assign(size.begin(), size.end());
    // The voxels are made once to be measured, and again for each file.
    result.seconds = voxels * seconds_per_voxel * (1.0 + formats);
    for (const config::FileFormat format : files.formats) {
        result.seconds += bytes * seconds_per_byte(format, files);
    }
    // Boxes on their way, as floats and as the file stores them.
    const BoxSequence boxes(size, static_cast<int>(channels));
    const double values = static_cast<double>(boxes.largest_count()) *
                          static_cast<double>(channels) * std::min(box_slots(0), boxes.count());
    // The libraries of files take as much again to pack them (measured, rounded up).
    result.memory_mib =
        2 * values * (4.0 + static_cast<double>(bytes_per_value(files.pixel_type))) / kMebibyte;
    result.disk_mib = bytes * formats / kMebibyte;
    return result;
}

}  // namespace skybake
