// What a sweep is to make, variant by variant.
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
    std::filesystem::path folder;  // of the variants' folders
    int shard = 1;                 // this one of `shards`: variants whose index is shard - 1, and
    int shards = 1;                // every `shards`-th after it
    int threads = 0;               // 0: as many as the machine has
    Certification certification = Certification::quick;
    bool force = false;                           // overwrite files that skybake did not write
    std::optional<double> memory_limit_mib = {};  // of all variants that are made at once
    std::filesystem::path cache = {};             // an asset cache; empty: none
};

// An asset that is to be made.
struct StaleAsset {
    std::string name;
    std::string key;
    std::string reason;  // the first: "not baked yet"
};

struct PlannedVariant {
    VariantResult result;  // of one that is done, or cannot even be read
    std::vector<StaleAsset> stale;
    std::vector<std::string> keys;  // of all its assets, in the recipe's order
    std::string last_failure;       // the first of its error.json, "E0402: ..."; empty: none
    double seconds = 0;             // estimates of what is stale
    double memory_mib = 0;

    bool to_be_made() const { return result.status == VariantStatus::missing; }
};

// Looks at every variant of the shard, on as many threads as the job has, and changes nothing.
// Variants stand in the order of their index. One that cannot be read, planned or made for lack of
// memory has failed; see plan_folder. None at all once `cancelled` is true.
std::vector<PlannedVariant> plan_sweep(const SweepJob& job, const std::function<bool()>& cancelled);

// Names of the variants' folders beside those of the job's sweep, in order: the values have changed
// since they were made.
std::vector<std::string> folders_of_earlier_sweeps(const SweepJob& job);

// The bake of one variant's folder; the recipe must outlive it.
FolderBake variant_bake(const SweepJob& job, const config::Recipe& recipe, const std::string& name);

// The asset that several of the variants to be made want alike, by name, and how many want it.
struct SharedAsset {
    std::string name;
    int variants = 0;  // that want it
    int bakes = 0;     // different ones that all of those are
};
std::vector<SharedAsset> shared_assets(const std::vector<PlannedVariant>& variants);

// Assets that several variants of a sweep want: each is made once, the others copy it.

// Knows where each shared asset lies, or that a variant is making it. Used by all variants'
// threads.
class ReadyAssets : public AssetSource {
  public:
    // An asset that several variants want.
    void share(const std::string& key) { states_.try_emplace(key); }
    bool is_shared(const std::string& key) const { return states_.contains(key); }
    // It lies in the folder of a variant that is up to date. Only before the threads start.
    void add(const std::string& key, std::filesystem::path folder);

    // Whether a variant that wants these keys can go on without waiting for another one. If so, it
    // is the one that makes those which are not ready: the keys in `made`, until `release`.
    bool claim(const std::vector<std::string>& keys, std::vector<std::string>& made);
    // Its making has ended; what it has not offered is for others to make.
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
