// Verification of one file of a volume.
#pragma once

#include <filesystem>

#include "bakers/io/manifest/examination.h"
#include "bakers/io/manifest/manifest.h"

namespace skybake {

// Makes every check that the file's format allows: size, layout, channels, pixel type, compression,
// metadata, finiteness, the hash of the voxels, the extremes of each channel, each probe and what
// the probes are said to catch. Reads the file as a stream.
void check_volume_file(Examination& examination, const std::filesystem::path& path,
                       const ManifestAsset& asset, const ManifestFile& file);

}  // namespace skybake
