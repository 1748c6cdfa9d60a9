// What a bake into a folder is to make, and why.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bakers/assets/estimate.h"
#include "bakers/io/files/output_folder.h"
#include "bakers/math/bake_options.h"
#include "bakers/workspace/asset_identity.h"
#include "bakers/workspace/asset_source.h"
#include "config/diagnostics/diagnostic.h"
#include "config/recipe/recipe.h"

namespace skybake {

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
