// What an asset is made of, as a fingerprint: equal keys, equal bytes.
#pragma once

#include <string>
#include <vector>

#include "bakers/io/manifest/manifest.h"
#include "bakers/math/bake_options.h"
#include "config/diagnostics/diagnostic.h"
#include "config/recipe/recipe.h"

namespace skybake {

// Everything that decides an asset's bytes. Not among them: time stamps, folders, threads, and how
// the recipe words its values.
struct AssetIdentity {
    std::string kind;       // "cloud_volume"
    std::string release;    // of this program: until 1.0 each may change any byte
    int baker_version = 0;  // of its baker
    Certification certification = Certification::quick;
    std::string parameters;             // TOML, canonical: those that the asset depends on
    std::vector<ManifestInput> inputs;  // files besides the recipe, by content
    std::string key;                    // key_of all of the above
};

// xxh3_hex of all of an identity but its key.
std::string key_of(const AssetIdentity& identity);

// Reads the asset's input files for their content. E0300: one cannot be read.
config::Outcome<AssetIdentity> asset_identity(const config::Recipe& recipe,
                                              const config::Bake& bake,
                                              Certification certification);

// Writes the identity into the asset's entry in a manifest.
void sign(const AssetIdentity& identity, ManifestAsset& entry);

// Why an asset of this identity is not the one of `previous`: "atmosphere.ground_albedo 0.3 -> 0.1"
// and so on, at most `longest` reasons, then how many more there are. Empty for equal keys.
std::vector<std::string> differences(const AssetIdentity& identity, const ManifestAsset& previous,
                                     std::size_t longest = 3);

}  // namespace skybake
