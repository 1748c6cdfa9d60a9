// Volumes as bare voxels: little-endian, without a header, x fastest, then y, then z, channels
// interleaved. What they mean is in the manifest.
#pragma once

#include <array>
#include <filesystem>

#include "bakers/field/volume.h"
#include "bakers/io/formats/exr/exr_volume.h"
#include "bakers/math/progress.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// Writes volume.levels[level], which has been surveyed, into an existing file: float, half, unorm8
// (v * 255) or unorm16 (v * 65535), rounded to nearest. True when the file is complete, false once
// progress->cancelled(). E0301 with the system's reason.
config::Outcome<bool> write_bin_volume(const BakedVolume& volume, int level, int threads,
                                       Progress* progress, const std::filesystem::path& path);

// Hands all voxels of a file to `visit`, piece after piece. False once visit returned false. E0300;
// E0304 where the file's length is not that of such a volume.
config::Outcome<bool> read_bin_volume(const std::filesystem::path& path,
                                      const std::array<int, 3>& size, int channels,
                                      config::PixelType type, const VoxelVisitor& visit);

}  // namespace skybake
