// Temporary files, `.NAME.skybake-PID-N.tmp` beside NAME, which replace NAME when they are
// complete.
#pragma once

#include <filesystem>
#include <vector>

#include "bakers/io/files/file_io.h"

namespace skybake {

// A new file beside the target. It is locked while it is open, and the destructor removes it unless
// it has been renamed to the target.
//
// A process that lives holds the lock of at least one of its temporaries in a folder, so that the
// others may be closed: as many files as a bake has may be staged with few descriptors.
class TemporaryFile {
  public:
    // The object is not valid if the file cannot be made; errno says why.
    explicit TemporaryFile(const std::filesystem::path& target);
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile();

    bool valid() const { return made_; }
    int descriptor() const { return file_.get(); }
    const std::filesystem::path& path() const { return path_; }
    // Ends writing. The file stays until it is renamed or the object is destroyed.
    void close() { file_ = FileDescriptor(); }
    // Leaves the file to the next process: neither a signal nor the destructor removes it.
    void leave_behind();
    // Replaces whatever is at the target, even a symbolic link. Returns false if that fails; errno
    // says why.
    bool rename_to(const std::filesystem::path& target);

  private:
    std::filesystem::path path_;
    int slot_ = -1;  // in the table of files that a signal handler removes
    FileDescriptor file_;
    bool made_ = false;  // and still to be removed
};

// Removes temporaries of `target` whose process is gone. Errors are not reported, because a leftover
// file does no harm.
void remove_stale_temporaries(const std::filesystem::path& target);

// Does the same for all targets in a folder but manifest.json, whose temporaries may be journals
// (journal.h).
void remove_stale_temporaries_in(const std::filesystem::path& folder);

// Returns the temporaries of `target`, whether their process lives or not, in no order.
std::vector<std::filesystem::path> temporaries_of(const std::filesystem::path& target);

// Remembers a folder that this process has made, the deepest of several first, for
// remove_unfinished_files of atomic_file.h.
void remember_made_folder(const std::filesystem::path& folder);

}  // namespace skybake
