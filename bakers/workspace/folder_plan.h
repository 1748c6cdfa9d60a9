// What a bake into a folder is to make, and why.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bakers/assets/estimate.h"
#include "bakers/io/files/output_folder.h"
#include "bakers/io/manifest/manifest.h"
#include "bakers/math/bake_options.h"
#include "bakers/workspace/copy_asset.h"
#include "config/diagnostics/diagnostic.h"
#include "config/recipe/recipe.h"

namespace skybake {

// What an asset is made of, as a fingerprint: equal keys, equal bytes.

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

struct FolderBake {
    const config::Recipe* recipe = nullptr;
    std::vector<config::Bake> bakes;  // all of the recipe, or some: then other entries stay
    std::filesystem::path folder;
    int threads = 0;  // 0: as many as the machine has
    Certification certification = Certification::quick;
    bool force = false;                           // overwrite files that skybake did not write
    bool prune = false;                           // remove what the recipe no longer asks for
    std::optional<double> memory_limit_mib = {};  // stop before starting if more may be needed
    std::vector<AssetSource*> sources = {};       // asked in this order, each offered what is new
};

struct PlannedAsset {
    const config::Bake* bake = nullptr;
    AssetIdentity identity;
    Estimate estimate;
    std::vector<std::string> reasons;         // why it is to be made; empty: it is up to date
    std::optional<ManifestAsset> up_to_date;  // its entry in the folder's manifest

    bool stale() const { return !up_to_date; }
};

struct FolderPlan {
    OutputFolder folder;
    std::vector<PlannedAsset> assets;  // in the order of FolderBake::bakes
    std::vector<RetiredFile> retired;  // of earlier recipes, and still there
    std::vector<RetiredFile> pruned;   // those of them that FolderBake::prune removes

    std::size_t stale_count() const;
    // The most memory that making what is stale may need at once: rough, as all estimates.
    double memory_mib() const;
};

// Whether a retired file is the one that skybake wrote: a plain file of the folder with the bytes
// that its manifest says. Only such a file is pruned.
bool is_as_written(const std::filesystem::path& folder, const RetiredFile& file);

// Looks, and changes nothing. Files of the manifest are up to date if they hold the bytes that it
// says, whatever their time stamps. E0002: more than memory_limit_mib; E0300 for inputs; E0302,
// E0303 as inspect_output_folder.
config::Outcome<FolderPlan> plan_folder(const FolderBake& bake);

}  // namespace skybake
