// Files that are looked at again and again, to see when one of them changes.
#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace skybake::cli {

class WatchedFiles {
  public:
    // The files to look at from now on; they may be missing. Those that were among the ones before
    // have changed if they did since wait() returned, new ones if they do after this call.
    void follow(const std::vector<std::filesystem::path>& paths);

    // Waits until a file was written, replaced, made or removed, and then until all have been at
    // rest for one look (editors write in several goes). True after a change, false once
    // interrupted. Looks by name, so that editors may rename a new file over the old one, at the
    // cost of one stat per file and look.
    bool wait();

    // Whether wait() would find a change at once. From any thread, while no other call is under
    // way.
    bool changed() const { return look() != seen_; }

  private:
    static constexpr std::chrono::milliseconds look_every{25};
    // Time, size and identity of a file; equal texts, untouched file.
    using Signs = std::map<std::filesystem::path, std::string>;
    Signs look() const;

    Signs seen_;
};

}  // namespace skybake::cli
