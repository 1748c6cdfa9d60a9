// A target's own files beside those of an asset: scripts, scenes and modules with which the program
// loads the asset. config/sections/targets.h says which target has which.
//
// Each is made of the text of the same name in this folder, NAME.three.js for `*.three.js`:
//
//   $KEY$                 stands for a value of the asset; sidecar.cpp lists the keys
//   $if KEY=word,other$   at the head of a line: the line stays only if the value is one of these words
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bakers/io/manifest/manifest.h"

namespace skybake {

struct Baked;

// The word that manifests have for the format of a sidecar.
inline constexpr std::string_view sidecar_format = "sidecar";

// Returns the names of the sidecars of an asset.
std::vector<std::string> sidecars_of(const Baked& baked);

// Returns the text of the sidecar with that file name. `asset` lists the asset's files.
std::string sidecar_text(const Baked& baked, const ManifestAsset& asset, const std::string& name);

// Returns the text that a sidecar of an asset called NAME is made of: "NAME.three.js".
std::string_view sidecar_template(std::string_view name);

}  // namespace skybake
