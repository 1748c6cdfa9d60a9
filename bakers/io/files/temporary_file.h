// Files on their way to become others: `.NAME.skybake-PID-N.tmp` beside NAME.
#pragma once

#include <filesystem>

#include "bakers/io/files/file_io.h"

namespace skybake {

// A new file beside the target, locked while it is open, removed with this object unless it has
// become the target.
class TemporaryFile {
  public:
    // Not valid where the file cannot be made; errno says why.
    explicit TemporaryFile(const std::filesystem::path& target);
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile();

    bool valid() const { return file_.valid(); }
    int descriptor() const { return file_.get(); }
    const std::filesystem::path& path() const { return path_; }
    // Replaces what is at the target, a symbolic link among others. False where it cannot; errno
    // says why.
    bool rename_to(const std::filesystem::path& target);

  private:
    std::filesystem::path path_;
    int slot_ = -1;  // in the table of what a signal handler removes
    FileDescriptor file_;
    bool renamed_ = false;
};

// Removes temporaries of `target` that no process is writing. Errors are not reported: a leftover
// is untidy, not wrong.
void remove_stale_temporaries(const std::filesystem::path& target);

// The same of all targets in a folder.
void remove_stale_temporaries_in(const std::filesystem::path& folder);

}  // namespace skybake
