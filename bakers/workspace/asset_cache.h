// A cache of baked assets by key, shared by recipes, processes and machines.
//
//   FOLDER/CACHEDIR.TAG                 so that backup programs leave it out
//   FOLDER/assets/ab/ab12.../           one asset: its files and a manifest.json of it alone
//   FOLDER/assets/ab/ab12.../manifest.json   its time stamp is that of the last use
//   FOLDER/pending/                     entries on their way in and out
//
// An entry appears and disappears as a whole, by a rename, so any number of processes may use a
// cache at once, and one that is killed leaves at most something in `pending`, which the next one
// that is offered an asset removes. Files are compared with their hashes whenever they are used:
// damage costs a bake, never a wrong texel. Nothing is written through a symbolic link.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bakers/workspace/copy_asset.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

class AssetCache : public AssetSource {
  public:
    // Makes the folder with its first entry.
    explicit AssetCache(std::filesystem::path folder) : folder_(std::move(folder)) {}

    std::optional<ReadyAsset> find(const std::string& key) override;
    // Removes the entry, so that a whole one can take its place.
    void reject(const ReadyAsset& asset) override;
    // A cache that cannot be written to, or is full, fails no bake: see problems().
    void offer(const ReadyAsset& asset) override;

    // Why the first offer that was not taken was not: a warning W0301.
    const std::vector<config::Diagnostic>& problems() const { return problems_; }

  private:
    std::filesystem::path folder_;
    std::vector<config::Diagnostic> problems_;
    bool tidied_ = false;  // what killed processes left in `pending` has been removed
};

struct CacheEntry {
    std::filesystem::path folder;
    std::string key;
    std::string kind;  // of its asset; empty where its manifest cannot be read
    std::uint64_t bytes = 0;
    std::int64_t last_use_s = 0;  // since 1970
};

// All entries, those used least recently first. A missing folder is an empty cache. E0300.
config::Outcome<std::vector<CacheEntry>> cache_entries(const std::filesystem::path& folder);

// Removes entries, those used least recently first, until at most `largest_bytes` are left, and
// what killed processes left in `pending`. The entries removed. E0300, E0301.
config::Outcome<std::vector<CacheEntry>> collect_garbage(const std::filesystem::path& folder,
                                                         std::uint64_t largest_bytes);

struct CacheVerification {
    std::size_t entries = 0;
    std::vector<std::filesystem::path> damaged;  // files that are not what their manifest says
};

// Reads every file. Removes entries that are damaged, since they are of no use. E0300, E0301.
config::Outcome<CacheVerification> verify_cache(const std::filesystem::path& folder);

}  // namespace skybake
