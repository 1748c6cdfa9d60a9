// The folder of a cache: how it is told from other folders, and the folders in its `pending`, in
// which processes prepare entries and remove them.
//
// A folder is a cache once it holds CACHEDIR.TAG (https://bford.info/cachedir/) with skybake's name.
// The tag is written before anything else, and nothing is removed from a folder without it.
//
// The bytes that runs keep in a cache's folder for each other, as entries beside those of assets.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "bakers/io/files/file_io.h"
#include "bakers/math/intermediates.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// Whether the folder holds the tag.
bool is_cache_folder(const std::filesystem::path& folder);

// Returns E0302 if the path is neither a cache nor can become one, because it is a file, or a folder
// that holds files but no tag. A missing or empty folder may become a cache.
[[nodiscard]] std::vector<Diagnostic> check_cache_folder(const std::filesystem::path& folder);

// Makes the folder a cache unless it is one. E0302 as above; E0301 if it cannot be written.
[[nodiscard]] std::vector<Diagnostic> make_cache_folder(const std::filesystem::path& folder);

// Opens the folder that holds entries whose keys begin like this one, `assets/XX`, after making it if
// wanted. It is not valid where it does not exist, cannot be made, or where a symbolic link stands in the
// way: what lies behind a link is not the cache's, and is neither read, written nor removed.
FileDescriptor group_folder(const std::filesystem::path& cache, const std::string& key, bool make);

// A folder in `pending`, named PID-N. It is locked while this process lives, and the destructor
// removes it with its contents.
class PendingFolder {
  public:
    // `error` says why there is no folder, for instance since `pending` is a symbolic link.
    PendingFolder(const std::filesystem::path& cache, std::error_code& error);
    PendingFolder(const PendingFolder&) = delete;
    PendingFolder& operator=(const PendingFolder&) = delete;
    ~PendingFolder();

    const std::filesystem::path& path() const { return path_; }

  private:
    bool lock();

    std::filesystem::path path_;
    FileDescriptor lock_;
};

// Removes the folders in `pending` that killed processes of this user left: those that are named
// PID-N and whose lock nobody holds. It follows no symbolic link, and does nothing in a folder that is
// no cache.
void remove_abandoned(const std::filesystem::path& cache);

class CachedBytes : public KeptBytes {
  public:
    // Without a folder it finds and keeps nothing. A folder that cannot be written keeps nothing either.
    explicit CachedBytes(std::filesystem::path cache) : cache_(std::move(cache)) {}

    // Removes an entry that is damaged.
    std::optional<std::string> find(const Name& name) override;
    void keep(const Name& name, std::string_view bytes) override { offer(name, bytes); }
    // Keeps them, or returns why not, as the warning W0301.
    std::vector<Diagnostic> offer(const Name& name, std::string_view bytes);

  private:
    std::filesystem::path cache_;
};

}  // namespace skybake
