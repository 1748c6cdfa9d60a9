// A cache of baked assets by key. Recipes, processes and machines may share it.
//
//   FOLDER/CACHEDIR.TAG                 makes it a cache (cache_folder.h)
//   FOLDER/assets/ab/ab12.../           one asset: its files and a manifest.json of it alone
//   FOLDER/assets/ab/ab12.../manifest.json   its time stamp is the time of the last use
//   FOLDER/pending/                     entries on their way in and out
//
// An entry appears and disappears as a whole, by a rename, so any number of processes may use a
// cache at once. A killed process leaves files only in `pending`, and the next process of the same user
// that adds an asset removes them. Files are compared with their hashes whenever they are used, so damage costs
// another bake but never gives a wrong texel. Nothing is written through a symbolic link.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/workspace/copy_asset.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

struct Baked;

class AssetCache : public AssetSource {
  public:
    // The folder is made with its first entry.
    explicit AssetCache(std::filesystem::path folder) : folder_(std::move(folder)) {}

    std::optional<ReadyAsset> find(const std::string& key) override;
    // Removes the entry, so that an undamaged one can take its place.
    void reject(const ReadyAsset& asset) override;
    // A bake does not fail if the cache cannot be written to or is full; see problems().
    void offer(const ReadyAsset& asset) override;
    // Does the same with an asset in memory, whose entry is signed (folder_plan.h).
    void offer(const Baked& baked, ManifestAsset entry, int threads);
    // Does the same with the bytes of the only file of a signed entry.
    void offer(std::string_view bytes, const ManifestAsset& entry);

    // Returns why the first rejected offer was rejected, as the warning W0301.
    const std::vector<Diagnostic>& problems() const { return problems_; }
    // Returns the number of assets that were offered and taken.
    int kept() const { return kept_; }

  private:
    // Stages the files of an asset into a folder, or returns why it cannot.
    using StageAsset = std::function<std::vector<Diagnostic>(const std::filesystem::path& folder,
                                                             AtomicFiles& files)>;
    void keep(const ManifestAsset& entry, const StageAsset& stage);

    std::filesystem::path folder_;
    std::vector<Diagnostic> problems_;
    int kept_ = 0;
    bool tidied_ = false;  // the remains of killed processes have been removed from `pending`
};

// --- What caches of every kind have in common ---------------------------------------------------

// Whether the text is a key or a hash, which has 32 hexadecimal digits. Other texts in a manifest
// must not become paths.
bool is_key(std::string_view key);

// Returns the text of the manifest with which a cache keeps an asset.
std::string cached_manifest_json(const ManifestAsset& entry);

// Whether the manifest is that of this key's asset alone, and unchanged since it was written.
bool is_entry_of(const Manifest& manifest, const std::string& key);

// --- Looking after a cache's folder -------------------------------------------------------------

struct CacheEntry {
    std::filesystem::path folder;
    std::string key;
    std::string kind;  // kind of its asset; empty if its manifest cannot be read
    std::uint64_t bytes = 0;
    std::int64_t last_use_s = 0;  // since 1970
};

// Returns all entries, the least recently used first. A missing folder is an empty cache. E0302 if
// the folder is no cache (check_cache_folder), E0300 if it cannot be read.
Outcome<std::vector<CacheEntry>> cache_entries(const std::filesystem::path& folder);

// Removes entries, the least recently used first, until at most `largest_bytes` are left, and also
// the remains of killed processes in `pending`. Returns the removed entries. E0300, E0301, E0302.
Outcome<std::vector<CacheEntry>> collect_garbage(const std::filesystem::path& folder,
                                                 std::uint64_t largest_bytes);

struct CacheVerification {
    std::size_t entries = 0;
    std::vector<std::filesystem::path> damaged;  // files that differ from their manifest
};

// Reads every file and removes damaged entries, which are useless. E0300, E0301, E0302.
Outcome<CacheVerification> verify_cache(const std::filesystem::path& folder);

}  // namespace skybake
