// Temporary files, `.NAME.skybake-PID-N.tmp` beside NAME, which replace NAME when they are
// complete.
#pragma once

#include <filesystem>

#include "bakers/io/files/file_io.h"

namespace skybake {

// A new file beside the target. It is locked while it is open, and the destructor removes it unless
// it has been renamed to the target.
class TemporaryFile {
  public:
    // The object is not valid if the file cannot be made; errno says why.
    explicit TemporaryFile(const std::filesystem::path& target);
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile();

    bool valid() const { return file_.valid(); }
    int descriptor() const { return file_.get(); }
    const std::filesystem::path& path() const { return path_; }
    // Replaces whatever is at the target, even a symbolic link. Returns false if that fails; errno
    // says why.
    bool rename_to(const std::filesystem::path& target);

  private:
    std::filesystem::path path_;
    int slot_ = -1;  // in the table of files that a signal handler removes
    FileDescriptor file_;
    bool renamed_ = false;
};

// Removes temporaries of `target` that no process is writing. Errors are not reported, because a
// leftover file does no harm.
void remove_stale_temporaries(const std::filesystem::path& target);

// Does the same for all targets in a folder.
void remove_stale_temporaries_in(const std::filesystem::path& folder);

// Remembers a folder that this process has made, the deepest of several first, for
// remove_unfinished_files of atomic_file.h.
void remember_made_folder(const std::filesystem::path& folder);

}  // namespace skybake
