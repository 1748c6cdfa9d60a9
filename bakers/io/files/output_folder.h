// The folder that a bake writes into: may it, and what is there already?
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

    // Why nothing is known of what the folder holds but which files are skybake's: a clause that
    // says what is wrong with its manifest. Empty: all is known.
    std::string reason = {};
};

// Looks, and changes nothing: call it before a long bake. `files` are the names that will be
// written, relative to the folder, manifest.json among them. E0302: the folder cannot be written
// to, or cannot be made. E0303: a file is there that no manifest of skybake's claims; one
// diagnostic for each; `force` lets them pass. Where nothing is `to_be_written` after all, a
// folder may be one for reading alone.
config::Outcome<OutputFolder> inspect_output_folder(const std::filesystem::path& folder,
                                                    std::span<const std::string> files, bool force,
                                                    bool to_be_written = true);

// Makes the folder where it is missing, and those above it; the folders made, the deepest first.
// E0302.
config::Outcome<std::vector<std::filesystem::path>> create_output_folder(
    const std::filesystem::path& folder);

// Takes back what create_output_folder made, as far as nothing is in there.
void remove_empty_folders(std::span<const std::filesystem::path> folders);

// The names of the files that a bake makes, relative to the output folder. They follow from the
// recipe alone.

// "NAME.exr", "NAME.vdb"; "NAME.mip1.exr" and so on for further levels of detail.
std::string file_name(const std::string& name, config::FileFormat format, int level);

// "NAME.json": a text beside the files of an asset.
std::string companion_file_name(const std::string& name, const std::string& format);

// All files of a [bake.NAME].
std::vector<std::string> file_names(const config::Bake& bake);

// One process at a time in a folder.

// Holds an advisory lock (flock) on the folder itself, so that nothing is left behind: the lock
// ends with this object or with the process, however it ends. File systems without such locks (NFS
// gives none on folders) are used without: two processes then may do the same work, but atomic
// renames still leave whole files.
class FolderLock {
  public:
    // Waits as long as another process has it: then calls `waits` once, and gives up once
    // `cancelled` is true, with neither value nor diagnostics. E0302: there is no such folder.
    static config::Outcome<FolderLock> acquire(const std::filesystem::path& folder,
                                               const std::function<void()>& waits,
                                               const std::function<bool()>& cancelled);

  private:
    explicit FolderLock(FileDescriptor folder) : folder_(std::move(folder)) {}

    FileDescriptor folder_;
};

}  // namespace skybake
