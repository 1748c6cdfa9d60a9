#include "bakers/workspace/sweep/ready_assets.h"

#include <algorithm>
#include <utility>

namespace skybake {

void ReadyAssets::add(const std::string& key, std::filesystem::path folder) {
    const auto state = states_.find(key);
    if (state != states_.end()) state->second.folder = std::move(folder);
}

bool ReadyAssets::claim(const std::vector<std::string>& keys, std::vector<std::string>& made) {
    const std::lock_guard lock(mutex_);
    made.clear();
    for (const std::string& key : keys) {
        const auto state = states_.find(key);
        if (state == states_.end() || !state->second.folder.empty()) continue;
        if (state->second.making) return false;
        made.push_back(key);
    }
    for (const std::string& key : made) states_[key].making = true;
    return true;
}

void ReadyAssets::release(const std::vector<std::string>& made) {
    const std::lock_guard lock(mutex_);
    for (const std::string& key : made) states_[key].making = false;
}

std::optional<ReadyAsset> ReadyAssets::find(const std::string& key) {
    std::filesystem::path folder;
    {
        const std::lock_guard lock(mutex_);
        const auto state = states_.find(key);
        if (state != states_.end()) folder = state->second.folder;
    }
    if (folder.empty()) return std::nullopt;
    auto manifest = read_manifest(folder);
    if (!manifest.value || !manifest.value->alterations.empty()) return std::nullopt;
    for (ManifestAsset& asset : manifest.value->assets) {
        if (asset.key == key) return ReadyAsset{std::move(folder), std::move(asset)};
    }
    return std::nullopt;
}

void ReadyAssets::offer(const ReadyAsset& asset) {
    const std::lock_guard lock(mutex_);
    const auto state = states_.find(asset.entry.key);
    if (state != states_.end()) state->second.folder = asset.folder;
}

}  // namespace skybake
