// The folder that a bake writes into: checks whether the bake may write there and what is there
// already, and locks the folder.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bakers/io/files/file_io.h"
#include "bakers/io/manifest/manifest.h"
#include "config/assets/output_files.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

struct OutputFolder {
    std::filesystem::path path;
    std::optional<Manifest> previous;  // the manifest of an earlier bake

    // If this is not empty, it says what is wrong with the folder's manifest, as a clause. Then
    // only the list of files that skybake wrote is known.
    std::string reason = {};
    // A bake was killed before its manifest got its name; `previous` holds what it had finished.
    bool is_unfinished = false;
};

// Inspects the folder and changes nothing; call it before a long bake. `files` are the names that
// will be written, relative to the folder, including manifest.json. E0302 if the folder cannot be
// written to or cannot be made. E0303 for each existing file that no manifest of skybake claims,
// unless `force` is set. If nothing is `to_be_written`, the folder may be read-only.
Outcome<OutputFolder> inspect_output_folder(const std::filesystem::path& folder,
                                            std::span<const std::string> files, bool force,
                                            bool to_be_written = true);

// Returns E0303 for a file that others have written; `why` follows "already exists and".
Diagnostic foreign_file(const std::filesystem::path& file, const std::string& why);

// Makes the folder and those above it if they are missing. Returns the folders made, the deepest
// first. E0302 if that fails.
Outcome<std::vector<std::filesystem::path>> create_output_folder(
    const std::filesystem::path& folder);

// Removes the folders that create_output_folder made, as far as they are empty.
void remove_empty_folders(std::span<const std::filesystem::path> folders);

static_assert(manifest_name == config::manifest_file);
using config::companion_file_name;
using config::file_name;
using config::file_names;

// Lets one process at a time work in a folder. It holds an advisory lock (flock) on the folder
// itself, so nothing is left behind: the lock ends with this object or with the process, however
// that ends. On file systems without such locks (NFS has none for folders), two processes may do
// the same work, but atomic renames still leave whole files.
class FolderLock {
  public:
    // Waits while another process holds the lock; in that case it calls `waits` once. If
    // `cancelled` becomes true, it gives up and returns neither a value nor a diagnostic. E0302 if
    // there is no such folder.
    static Outcome<FolderLock> acquire(const std::filesystem::path& folder,
                                       const std::function<void()>& waits,
                                       const std::function<bool()>& cancelled);

  private:
    explicit FolderLock(FileDescriptor folder) : folder_(std::move(folder)) {}

    FileDescriptor folder_;
};

}  // namespace skybake
