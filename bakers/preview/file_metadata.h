// What a file says of itself, for files that no manifest claims.
#pragma once

#include <filesystem>

#include "bakers/io/manifest/manifest.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// The entry that a manifest would have of an EXR or VDB file, as far as its metadata say it: kind,
// content, size, channels, mapping, statistics, parameters, hashes. Its error figures stand in
// `details`, in words. The one file's path is its name. E0300, E0304; E0304, too, where the file
// has no metadata of skybake's (bare voxels never have).
config::Outcome<ManifestAsset> entry_from_metadata(const std::filesystem::path& file);

}  // namespace skybake
