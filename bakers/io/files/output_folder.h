// The folder that a bake writes into: checks whether the bake may write there and what is there
// already, names the files, and locks the folder.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bakers/io/files/file_io.h"
#include "bakers/io/manifest/manifest.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/files.h"
#include "config/sections/parameters.h"

namespace skybake {

struct OutputFolder {
    std::filesystem::path path;
    std::optional<Manifest> previous;  // the manifest of an earlier bake

    // If this is not empty, it says what is wrong with the folder's manifest, as a clause. Then
    // only the list of files that skybake wrote is known.
    std::string reason = {};
};

// Inspects the folder and changes nothing; call it before a long bake. `files` are the names that
// will be written, relative to the folder, including manifest.json. E0302 if the folder cannot be
// written to or cannot be made. E0303 for each existing file that no manifest of skybake claims,
// unless `force` is set. If nothing is `to_be_written`, the folder may be read-only.
config::Outcome<OutputFolder> inspect_output_folder(const std::filesystem::path& folder,
                                                    std::span<const std::string> files, bool force,
                                                    bool to_be_written = true);

// Makes the folder and those above it if they are missing. Returns the folders made, the deepest
// first. E0302 if that fails.
config::Outcome<std::vector<std::filesystem::path>> create_output_folder(
    const std::filesystem::path& folder);

// Removes the folders that create_output_folder made, as far as they are empty.
void remove_empty_folders(std::span<const std::filesystem::path> folders);

// Returns the name of an asset's file, relative to the output folder: "NAME.exr" or "NAME.vdb" for
// level 0, "NAME.mip1.exr" and so on for further levels of detail. It follows from the recipe
// alone.
std::string file_name(const std::string& name, config::FileFormat format, int level);

// Returns the same for an asset with `files`. A scene that plays a sequence, of which the asset is the
// first frame, has the name of the sequence.
std::string file_name(const std::string& name, const config::AssetFiles& files,
                      config::FileFormat format, int level);

// Returns the name of a text file beside the files of an asset: "NAME.json".
std::string companion_file_name(const std::string& name, const std::string& format);

// Returns the names of all files of a [bake.NAME].
std::vector<std::string> file_names(const config::Bake& bake);

// Lets one process at a time work in a folder. It holds an advisory lock (flock) on the folder
// itself, so nothing is left behind: the lock ends with this object or with the process, however
// that ends. On file systems without such locks (NFS has none for folders), two processes may do
// the same work, but atomic renames still leave whole files.
class FolderLock {
  public:
    // Waits while another process holds the lock; in that case it calls `waits` once. If
    // `cancelled` becomes true, it gives up and returns neither a value nor a diagnostic. E0302 if
    // there is no such folder.
    static config::Outcome<FolderLock> acquire(const std::filesystem::path& folder,
                                               const std::function<void()>& waits,
                                               const std::function<bool()>& cancelled);

  private:
    explicit FolderLock(FileDescriptor folder) : folder_(std::move(folder)) {}

    FileDescriptor folder_;
};

}  // namespace skybake
