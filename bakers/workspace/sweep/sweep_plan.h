// Plans a sweep: which assets must be made, variant by variant, and which of them variants share.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "bakers/math/bake_options.h"
#include "bakers/workspace/copy_asset.h"
#include "bakers/workspace/folder_plan.h"
#include "bakers/workspace/sweep/variants.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sweep/sweep.h"

namespace skybake {

struct SweepJob {
    std::filesystem::path recipe;
    std::vector<std::string> settings;  // texts of --set, for all variants
    config::Sweep sweep;
    std::filesystem::path folder;  // the parent of the variants' folders
    int shard = 1;                 // this one of `shards`: variants whose index is shard - 1, and
    int shards = 1;                // every `shards`-th after it
    int threads = 0;               // 0: as many as the machine has
    Certification certification = Certification::quick;
    bool force = false;                           // overwrite files that skybake did not write
    std::optional<double> memory_limit_mib = {};  // of all variants that are made at once
    std::filesystem::path cache = {};             // an asset cache; empty: none
    AssetSource* server = nullptr;  // another source of assets, for all threads; null: none
};

// An asset that must be made.
struct StaleAsset {
    std::string name;
    std::string key;
    std::string reason;  // the first reason: "not baked yet"
};

struct PlannedVariant {
    VariantResult result;  // complete if it is done or cannot be read
    std::vector<StaleAsset> stale;
    std::vector<Need> needs;        // what stale assets share, also with those of other variants
    std::vector<std::string> keys;  // of all its assets, in the recipe's order
    std::string last_failure;       // the first error of error.json, "E0402: ..."; empty: none
    double seconds = 0;             // estimates for the stale assets
    double memory_mib = 0;

    bool to_be_made() const { return result.status == VariantStatus::missing; }
};

// Plans every variant of the shard, on as many threads as the job has, and changes nothing. The
// result is in the order of the variants' indices. A variant that cannot be read or planned, or
// that needs too much memory, has failed; see plan_folder. Returns nothing once `cancelled` is
// true.
std::vector<PlannedVariant> plan_sweep(const SweepJob& job, const std::function<bool()>& cancelled);

// Returns the names of variants' folders that do not belong to the job's sweep, in order. They were
// made before the sweep's values changed.
std::vector<std::string> folders_of_earlier_sweeps(const SweepJob& job);

// Returns the bake of one variant's folder. The recipe must outlive it.
FolderBake variant_bake(const SweepJob& job, const Recipe& recipe, const std::string& name);

// An asset, by name, that several of the variants to be made need in the same form.
struct SharedAsset {
    std::string name;
    int variants = 0;  // number of variants that need it
    int bakes = 0;     // the number of different assets of this name among them
};
std::vector<SharedAsset> shared_assets(const std::vector<PlannedVariant>& variants);

// Returns what is made once for all of the variants to be made whose assets need it, in the order in
// which it is first needed.
std::vector<PlannedIntermediate> shared_intermediates(const std::vector<PlannedVariant>& variants);

// The assets that several variants of a sweep need: one variant makes each asset and the others
// copy it. This class knows where a shared asset is, or that a variant is making it. The threads of
// all variants use it.
class ReadyAssets : public AssetSource {
  public:
    // Registers an asset that several variants need.
    void share(const std::string& key) { states_.try_emplace(key); }
    // Says that the asset is in the folder of a variant that is up to date. Call it only before the
    // threads start.
    void add(const std::string& key, std::filesystem::path folder);

    // Returns whether a variant that needs these keys can start without waiting for another one. If
    // so, this variant makes the assets that are not ready: the keys in `made`, until `release`.
    bool claim(const std::vector<std::string>& keys, std::vector<std::string>& made);
    // Says that the variant has ended. Others may make the assets that it has not offered.
    void release(const std::vector<std::string>& made);

    std::optional<ReadyAsset> find(const std::string& key) override;
    void offer(const ReadyAsset& asset) override;

  private:
    struct State {
        bool making = false;
        std::filesystem::path folder;  // empty: not ready
    };

    std::mutex mutex_;
    std::map<std::string, State> states_;
};

}  // namespace skybake
