// Plans a bake into a folder: which assets must be made, and why.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bakers/assets/description/estimate.h"
#include "bakers/io/files/output_folder.h"
#include "bakers/io/manifest/manifest.h"
#include "bakers/math/bake_options.h"
#include "bakers/math/intermediates.h"
#include "bakers/workspace/copy_asset.h"
#include "config/diagnostics/diagnostic.h"
#include "config/recipe/recipe.h"

namespace skybake {

// Everything that an asset's bytes depend on: assets with equal keys have equal bytes. Time stamps,
// folders, threads and the wording of the recipe's values are not part of it.
struct AssetIdentity {
    std::string kind;       // "cloud_volume"
    std::string release;    // of this program; until 1.0, each release may change any byte
    int baker_version = 0;  // of the asset's baker
    Certification certification = Certification::quick;
    std::string parameters;             // canonical TOML of those that the asset depends on
    std::vector<ManifestInput> inputs;  // files besides the recipe, by content
    std::string
        sidecars;     // the texts that a target's own files are made of, and revisions of formats
    std::string key;  // key_of all of the above
};

// Returns the xxh3_hex of an identity without its key.
std::string key_of(const AssetIdentity& identity);

// Makes the identity of an asset. Reads the asset's input files to hash them; E0300 if one cannot
// be read.
Outcome<AssetIdentity> asset_identity(const Recipe& recipe, const Bake& bake,
                                      Certification certification);

// Writes the identity into the asset's entry in a manifest.
void sign(const AssetIdentity& identity, ManifestAsset& entry);

// Returns why an asset with this identity differs from the one of `previous`:
// "atmosphere.ground_albedo 0.3 -> 0.1" and so on. There are at most `longest` reasons, followed by
// the number of further ones. Empty for equal keys.
std::vector<std::string> differences(const AssetIdentity& identity, const ManifestAsset& previous,
                                     std::size_t longest = 3);

struct FolderBake {
    const Recipe* recipe = nullptr;
    std::vector<Bake> bakes;  // all of the recipe or some; with some, other entries stay
    std::filesystem::path folder;
    int threads = 0;  // 0: as many as the machine has
    Certification certification = Certification::quick;
    bool force = false;                           // overwrite files that skybake did not write
    std::filesystem::path depfile = {};           // gets rules for Make later; empty: none
    bool prune = false;                           // remove what the recipe no longer asks for
    bool frame_by_frame = false;                  // give each frame its name when it is complete
    std::optional<double> memory_limit_mib = {};  // stop before starting if more may be needed
    // Memory for voxels that are held (BakeOptions), as far as memory_limit_mib leaves it.
    std::int64_t held_voxel_bytes = BakeOptions().held_voxel_bytes;
    Intermediates* intermediates = nullptr;  // shared by several bakes; null: the bake has its own
    KeptBytes* kept = nullptr;               // that its own have from earlier runs; null: nothing
    std::vector<AssetSource*> sources = {};  // asked in this order; each is offered new assets
};

struct PlannedAsset {
    const Bake* bake = nullptr;
    AssetIdentity identity;
    Estimate estimate;
    std::vector<Need> needs;                  // what a stale asset shares with others
    std::vector<std::string> reasons;         // why it must be made; empty: it is up to date
    std::optional<ManifestAsset> up_to_date;  // its entry in the folder's manifest

    bool stale() const { return !up_to_date; }
};

// Something that is made once for all that need it.
struct PlannedIntermediate {
    Need need;
    std::vector<std::string> users;  // names of stale assets, or of a sweep's variants
};

// Notes that `user` has a need. All needs of a user follow each other.
void add_need(const Need& need, const std::string& user, std::vector<PlannedIntermediate>& plan);

// The program takes so much with its modules and the light that it solves for, and so much for each thread
// (measured, rounded up).
inline constexpr double kProgramMib = 80;
inline constexpr double kThreadMib = 16;

struct FolderPlan {
    OutputFolder folder;
    int threads = 1;                   // that make it
    std::vector<PlannedAsset> assets;  // in the order of FolderBake::bakes
    std::vector<RetiredFile> retired;  // from earlier recipes, and still there
    std::vector<RetiredFile> pruned;   // the files of `retired` that prune removes

    std::size_t stale_count() const;
    // In the order in which they are first needed.
    std::vector<PlannedIntermediate> intermediates() const;
    // A rough estimate, in MiB, of the most memory that making the stale assets needs at once.
    double memory_mib() const;
    // A rough estimate of the time that making them takes on one core: of texels by their number, of
    // light by the altitudes of its solution and the depth of the air (Estimate, Need).
    double seconds() const;
};

// Returns the folder's entry of an asset, as it was before the bake, or null.
const ManifestAsset* entry_before(const OutputFolder& folder, const std::string& name);

// Returns the bytes that may be kept of what is made: `most`, or what a bake that needs `used_mib`
// leaves of a limit.
std::int64_t bytes_to_keep(std::int64_t most, std::optional<double> limit_mib, double used_mib);

// Makes a plan without changing anything. A file is up to date if it holds the bytes that the
// manifest says, whatever its time stamp. E0002 if more than memory_limit_mib would be needed;
// E0300 for inputs; E0303, and E0302 if it is to be written, as for inspect_output_folder. E0302 if an output
// would replace another one or a file that the recipe is made from, whatever `force` says.
Outcome<FolderPlan> plan_folder(const FolderBake& bake, bool to_be_written = true);

}  // namespace skybake
