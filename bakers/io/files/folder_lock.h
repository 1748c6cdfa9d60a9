// One process at a time in a folder.
#pragma once

#include <filesystem>
#include <functional>

#include "bakers/io/files/file_descriptor.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

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
