// From a baked asset to its files and its entry in the manifest, and back.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bakers/field/baked.h"
#include "bakers/io/files/atomic_file.h"
#include "bakers/io/manifest/manifest.h"
#include "bakers/math/bake_options.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// What became of each file of the asset, in the order of ManifestAsset::files.
using StagedFiles = std::vector<WriteResult>;

// The asset's entry in the manifest, with all its files, whose lengths and hashes staging fills in.
// Every level has been surveyed.
ManifestAsset describe_with_files(const Baked& baked);

// Writes one file of `asset`, over an existing one. As Format::write: true when it is complete,
// false once progress->cancelled().
config::Outcome<bool> write_asset_file(const Baked& baked, const ManifestAsset& asset,
                                       const ManifestFile& file, int threads, Progress* progress,
                                       const std::filesystem::path& path);

// Makes the texels of each file of `asset` again, writes and stages it for the folder; adds the
// time it took to asset.timing.write_s. Memory does not grow with a volume. The last result is
// `interrupted` where progress->cancelled(). E0301 with the system's reason; E0500 where a level
// has not been surveyed, or a format does not have the pixel type.
config::Outcome<StagedFiles> stage_files(const Baked& baked, ManifestAsset& asset,
                                         const std::filesystem::path& folder, AtomicFiles& files,
                                         int threads, Progress* progress = nullptr);

// Hands all voxels of a level of a file to `visit`, as Format::read. `level` counts from the file's
// own.
config::Outcome<bool> read_asset_file(const std::filesystem::path& path, const ManifestAsset& asset,
                                      const ManifestFile& file, int level,
                                      const VoxelVisitor& visit);

}  // namespace skybake
