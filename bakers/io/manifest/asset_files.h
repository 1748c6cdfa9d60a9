// Writes the files of a baked asset, describes them in its manifest entry, and reads them back.
#pragma once

#include <filesystem>
#include <vector>

#include "bakers/io/files/atomic_file.h"
#include "bakers/io/manifest/manifest.h"
#include "bakers/math/bake_options.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

struct Baked;

// The result for each file of the asset, in the order of ManifestAsset::files.
using StagedFiles = std::vector<WriteResult>;

// Returns the asset's entry in the manifest with all its files. Staging fills in their lengths and
// hashes. Every level must have been surveyed.
ManifestAsset describe_with_files(const Baked& baked);

// Writes one file of `asset` over an existing one. Returns true when it is complete, false once
// progress->cancelled(), as Format::write does.
Outcome<bool> write_asset_file(const Baked& baked, const ManifestAsset& asset,
                               const ManifestFile& file, int threads, Progress* progress,
                               const std::filesystem::path& path);

// Makes the texels of each file of `asset` again, writes the file and stages it for the folder.
// Adds the time taken to asset.timing.write_s. Memory use does not grow with the size of a volume.
// The last result is `interrupted` if progress->cancelled(). E0301 has the system's reason; E0500
// if a level has not been surveyed or a format does not have the pixel type.
Outcome<StagedFiles> stage_files(const Baked& baked, ManifestAsset& asset,
                                 const std::filesystem::path& folder, AtomicFiles& files,
                                 int threads, Progress* progress = nullptr);

// Passes all voxels of a level of a file to `visit`, as Format::read does. `level` counts from the
// file's first level.
Outcome<bool> read_asset_file(const std::filesystem::path& path, const ManifestAsset& asset,
                              const ManifestFile& file, int level, const VoxelVisitor& visit);

}  // namespace skybake
