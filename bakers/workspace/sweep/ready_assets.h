// Assets that several variants of a sweep want: each is made once, the others copy it.
#pragma once

#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "bakers/workspace/asset_source.h"

namespace skybake {

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
