// Shared by the tests of VDB files.
#pragma once

#include <array>
#include <filesystem>
#include <fstream>

#include "bakers/field/pixel_type.h"
#include "bakers/io/formats/vdb/vdb_file.h"
#include "tests/support/volumes.h"

namespace skybake::testing {

// In [0, 1], different for neighbours and channels, no half, and one in seven is 0.
inline float voxel_with_zeros(int x, int y, int z, int channel) {
    return (x + 2 * y + 3 * z + channel) % 7 == 0 ? 0 : sample_voxel(x, y, z, channel);
}

inline Baked vdb_sample(const std::array<int, 3>& size, int channels, config::PixelType type,
                        config::VdbCompression compression = config::VdbCompression::none) {
    Baked volume = plain_volume(size, channels, type, voxel_with_zeros);
    volume.channel_names = {"R", "G", "B", "A"};
    volume.channel_names.resize(static_cast<std::size_t>(channels));
    volume.vdb_compression = compression;
    volume.minimum_m = {-100, 0.25, 1e4};
    volume.levels[0].content_hash = "0123456789abcdef0123456789abcdef";
    return volume;
}

inline config::Outcome<bool> write_sample(const Baked& volume, const std::filesystem::path& path,
                                          int threads = 2) {
    std::ofstream(path, std::ios::app);  // the writer wants a file
    const Attributes attributes = {{"skybake/kind", "noise_volume"}, {"skybake/release", "1"}};
    return write_vdb(volume, 0, attributes, threads, nullptr, path);
}

}  // namespace skybake::testing
