// Where an asset may lie ready-made, so that it need not be baked again.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "bakers/io/manifest/manifest.h"

namespace skybake {

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

}  // namespace skybake
