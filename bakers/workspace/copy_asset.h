// Ready-made files into another folder.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bakers/io/files/atomic_file.h"
#include "bakers/io/manifest/manifest.h"
#include "bakers/math/bake_options.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// Where an asset may lie ready-made, so that it need not be baked again.

// An asset whose files lie in a folder, under the names of its entry.
struct ReadyAsset {
    std::filesystem::path folder;
    ManifestAsset entry;
};

class AssetSource {
  public:
    virtual ~AssetSource() = default;
    // The asset of this key, or none. Its files are looked at again before they are used, so they
    // may be damaged or vanish at any time. May wait for another thread that is making it.
    virtual std::optional<ReadyAsset> find(const std::string& key) = 0;
    // What `find` gave cannot be read, or is not what its entry says.
    virtual void reject(const ReadyAsset& /*asset*/) {}
    // An asset that has just been baked, its files complete under their names.
    virtual void offer(const ReadyAsset& asset) = 0;
};

// Stages a copy of each of the asset's files, and says what became of it; the last is `interrupted`
// where progress.cancelled(). E0300, E0304 where a file cannot be read or does not hold the bytes
// that its entry says: then nothing of the asset is staged. E0301 where a copy cannot be written.
config::Outcome<std::vector<WriteResult>> stage_copies(const ReadyAsset& asset,
                                                       const std::filesystem::path& folder,
                                                       AtomicFiles& files,
                                                       const Progress& progress);

}  // namespace skybake
