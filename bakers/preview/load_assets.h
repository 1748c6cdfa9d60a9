// Loads baked files, and the plots of reports, for a preview.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "bakers/io/manifest/manifest.h"
#include "bakers/preview/bake_assets.h"
#include "bakers/workspace/copy_asset.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// Loads all assets of a baked folder, the recipe that its manifest recorded, and the plots of a
// report in the folder. `path` is the folder or the manifest. E0300 and E0304 are those of the
// readers of manifests and files; also E0304 if the manifest has no assets. Warning W0304, which
// also becomes a note: a shown file is not the one that the manifest describes. Volumes
// have no voxels where only tables are wanted.
enum class LoadedTexels { all, tables };
Outcome<PreviewAssets> load_folder(const std::filesystem::path& path,
                                   LoadedTexels texels = LoadedTexels::all);

// Adds an asset that was baked before, under the given name. Returns false and adds nothing if a file
// cannot be read, or differs from its entry.
bool add_ready(const ReadyAsset& ready, const std::string& name, PreviewAssets& shown);

// Loads single files of any format. Each file is described by the manifest of its folder or, if no
// manifest claims it, by its own metadata. The recipe is that of the first file's folder, or the
// one that a single file states. E0300; E0304 also if a file does not describe itself, or describes
// itself wrongly. Warnings are those of load_folder.
Outcome<PreviewAssets> load_files(std::span<const std::filesystem::path> files);

}  // namespace skybake
