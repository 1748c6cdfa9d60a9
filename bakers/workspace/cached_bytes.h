// The bytes that runs keep in a cache's folder for each other, as entries beside those of assets.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "bakers/math/intermediates.h"

namespace skybake {

class CachedBytes : public KeptBytes {
  public:
    // Without a folder it finds and keeps nothing. A folder that cannot be written keeps nothing either;
    // AssetCache says so of the assets.
    explicit CachedBytes(std::filesystem::path cache) : cache_(std::move(cache)) {}

    // Removes an entry that is damaged.
    std::optional<std::string> find(const Name& name) override;
    void keep(const Name& name, std::string_view bytes) override;

  private:
    std::filesystem::path cache_;
};

}  // namespace skybake
