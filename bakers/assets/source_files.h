// The files of assets that are made from another asset, for checks of a whole folder.
#pragma once

#include <string>

#include "bakers/io/manifest/manifest.h"

namespace skybake {

// Returns the asset of this name, or null.
const ManifestAsset* asset_named(const Manifest& manifest, const std::string& name);

// Returns the first file that holds the volume itself and can be read back, or null.
const ManifestFile* first_file(const ManifestAsset& asset);

}  // namespace skybake
