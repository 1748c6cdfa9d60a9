// From a baked volume to its files and its entry in the manifest.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bakers/field/volume.h"
#include "bakers/io/files/atomic_file.h"
#include "bakers/io/manifest/manifest.h"
#include "bakers/math/progress.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// What became of each file of the asset, in the order of ManifestAsset::files.
using StagedVolume = std::vector<WriteResult>;

// The volume's entry in the manifest, with a file for each format and level, whose lengths and
// hashes staging fills in. Every level has been surveyed.
ManifestAsset describe_with_files(const BakedVolume& volume);

// Writes one file of `asset`, over an existing one. As the writers of its format: true when it is
// complete, false once progress->cancelled().
config::Outcome<bool> write_volume_file(const BakedVolume& volume, const ManifestAsset& asset,
                                        const ManifestFile& file, int threads, Progress* progress,
                                        const std::filesystem::path& path);

// Makes the voxels of each file of `asset` again, writes and stages it for the folder; adds the
// time it took to asset.timing.write_s. Memory does not grow with the volume. The last result is
// `interrupted` where progress->cancelled(). E0301 with the system's reason; E0500 where a level
// has not been surveyed, or a format does not have the pixel type.
config::Outcome<StagedVolume> stage_volume(const BakedVolume& volume, ManifestAsset& asset,
                                           const std::filesystem::path& folder, AtomicFiles& files,
                                           int threads, Progress* progress = nullptr);

}  // namespace skybake
