// Voxels in a file of numbers alone, whose layout is known beforehand.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>

#include "bakers/io/volumes/file_voxels.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/volume.h"

namespace skybake {

struct RawLayout {
    std::array<int, 3> size{};
    PixelType type = PixelType::float32;  // of number_types
    config::ByteOrder byte_order = config::ByteOrder::little;
    config::AxisOrder axis_order = config::AxisOrder::xyz;
    std::uint64_t offset = 0;  // bytes before the first voxel
};

// Opens a file of this layout. Integers of n bits become v / (2^n - 1). Before voxels are returned,
// all of them have been read once. E0300 if the file cannot be read; E0304 if its size is not that of
// the layout, or if a voxel is not finite, unless such voxels are the background, 0.
Outcome<FileVoxels> open_raw_volume(const std::filesystem::path& path, const RawLayout& layout,
                                    VolumePart part,
                                    config::NotFinite not_finite = config::NotFinite::refuse);

}  // namespace skybake
