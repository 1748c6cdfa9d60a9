// Writes files atomically: a file has either its old or its new contents, whatever happens in
// between.
//
// The bytes are written to the temporary file `.NAME.skybake-PID-N.tmp` in the same folder, flushed
// to the disk, and renamed over the target. After an error, an interruption or a full disk, the
// temporary is removed. A temporary of a killed process is removed by the next write of the same
// file, even if its bytes do not change.
//
// A symbolic link at the target is replaced by the file. It is never followed, because it may point
// outside of the folder to a file of somebody else. Links into /dev and /proc, such as /dev/stdout
// itself, are refused.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <string_view>
#include <vector>

#include "bakers/math/bake_options.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

enum class WriteResult {
    written,
    unchanged,    // the file already held these bytes; it and its time stamp did not change
    interrupted,  // progress->cancelled() became true: nothing was changed
};

// Writes a whole file over the empty temporary. Returns true when everything is written, false if
// it stopped for an interruption. A diagnostic may name the temporary; `stage` replaces that name
// by the file's own.
using FileWriter = std::function<Outcome<bool>(const std::filesystem::path& temporary)>;

enum class LeftOvers {
    to_be_removed,      // of killed processes, when the same file is written
    already_looked_for  // because the caller has: looking costs a reading of the folder for each file
};

// Several files of one folder that belong together. All are on the disk before the first replaces an
// old one, so a full disk or an interruption leaves every old file in place. At most three are open at
// once. The destructor removes files that were not committed.
class AtomicFiles {
  public:
    explicit AtomicFiles(LeftOvers left_overs = LeftOvers::to_be_removed);
    AtomicFiles(const AtomicFiles&) = delete;
    AtomicFiles& operator=(const AtomicFiles&) = delete;
    ~AtomicFiles();

    // Writes `bytes` to the disk under a temporary name. An existing file keeps its permissions; a
    // new file, or one that replaces a symbolic link, gets those of the umask. E0301, with the
    // system's reason, if the file cannot be written: no such folder, not permitted, read-only,
    // disk full, or the name belongs to a folder or a device.
    Outcome<WriteResult> stage(const std::filesystem::path& path, std::string_view bytes,
                               const Progress* progress = nullptr);

    // Does the same for a file that is too large for memory or that a library writes itself. It is
    // always written completely, even if the old file turns out to hold the same bytes.
    Outcome<WriteResult> stage(const std::filesystem::path& path, const FileWriter& write,
                               const Progress* progress = nullptr);

    std::size_t size() const { return staged_.size(); }
    // Removes all staged files but the first `count`.
    void shrink(std::size_t count);

    // Renames the staged files to their targets, in order. The folder is flushed before the last one
    // and after it: whoever sees the last file, such as a manifest, sees the others, also after a
    // power cut. E0301 if a file cannot be renamed; it and those after it stay staged.
    [[nodiscard]] std::vector<Diagnostic> commit();

  private:
    struct Staged;

    LeftOvers left_overs_;
    std::vector<std::unique_ptr<Staged>> staged_;
};

// Stages and commits a single file.
Outcome<WriteResult> write_file_atomically(const std::filesystem::path& path,
                                           std::string_view bytes,
                                           const Progress* progress = nullptr);

// Unlinks the temporaries that this process is writing now, and removes the folders that it made and
// that are still empty. The function is async-signal-safe; call _exit after it.
void remove_unfinished_files() noexcept;

// True while files that belong together get their names, which takes milliseconds. A process that
// ended meanwhile would leave some of them old. The function is async-signal-safe.
bool is_renaming_files() noexcept;

}  // namespace skybake
