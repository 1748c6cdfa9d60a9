// The files that a manifest lists, for looking up many.
#pragma once

#include <filesystem>
#include <set>
#include <string>

#include "bakers/io/manifest/manifest.h"

namespace skybake {

// Paths relative to the manifest's folder, and the manifest itself.
class ClaimedFiles {
  public:
    explicit ClaimedFiles(const Manifest& manifest);
    bool hold(const std::filesystem::path& file) const { return files_.contains(name_of(file)); }

  private:
    static std::string name_of(const std::filesystem::path& file);
    void add(const std::string& file) { files_.insert(name_of(file)); }

    std::set<std::string> files_;
};

}  // namespace skybake
