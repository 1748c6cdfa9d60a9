// The voxels of a file of a volume, whatever its format.
#pragma once

#include <filesystem>

#include "bakers/io/formats/exr/exr_volume.h"
#include "bakers/io/manifest/manifest.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// Hands the voxels of a file of `asset` to `visit`, in order and in bounded memory. False once
// visit returns false. Diagnostics as of the reader of its format; E0304, too, where the file is
// not of the size that the manifest says.
config::Outcome<bool> read_volume(const std::filesystem::path& path, const ManifestAsset& asset,
                                  const ManifestFile& file, const VoxelVisitor& visit);

}  // namespace skybake
