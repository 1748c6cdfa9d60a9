// Files that are either the old ones or the new ones, whatever happens in between.
//
// The bytes go to `.NAME.skybake-PID-N.tmp` in the same folder, are flushed to the disk and renamed
// over the target. An error, an interruption or a full disk removes the temporary; what a killed
// process left behind is removed by the next write of the same file, even of the same bytes.
//
// A symbolic link at the place of a file is replaced by the file. It is never followed: what it
// points to may lie outside of the folder and belong to somebody else. Links into /dev and /proc,
// such as /dev/stdout itself, are refused.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "bakers/math/bake_options.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

enum class WriteResult {
    written,
    unchanged,    // the file held these bytes already: it and its time stamp were left alone
    interrupted,  // progress->cancelled() became true: nothing was changed
};

// Writes a whole file under the name it is given, over an empty one. True when all is written,
// false where it has stopped for an interruption; a diagnostic may name the temporary, which
// `stage` replaces by the file's own name.
using FileWriter = std::function<config::Outcome<bool>(const std::filesystem::path& temporary)>;

// Several files that belong together. All are on the disk before the first replaces an old one, so
// a full disk or an interruption leaves every old file in place. What was not committed is removed
// with this object.
class AtomicFiles {
  public:
    AtomicFiles();
    AtomicFiles(const AtomicFiles&) = delete;
    AtomicFiles& operator=(const AtomicFiles&) = delete;
    ~AtomicFiles();

    // Brings `bytes` to the disk under a temporary name. An existing file keeps its permissions, a
    // new one gets those of the umask, and so does one that replaces a symbolic link. E0301 with
    // the system's reason where the file cannot be written: no such folder, not permitted,
    // read-only, disk full, a folder or a device of that name.
    config::Outcome<WriteResult> stage(const std::filesystem::path& path, std::string_view bytes,
                                       const Progress* progress = nullptr);

    // The same for a file that is too large to be held in memory, or that a library writes itself.
    // It is written whole even where the old file turns out to hold the same bytes.
    config::Outcome<WriteResult> stage(const std::filesystem::path& path, const FileWriter& write,
                                       const Progress* progress = nullptr);

    // Adds the staged files of another to these, after them.
    void take(AtomicFiles&& others);

    // Renames the staged files to their targets, the last one first: a manifest, staged when all
    // that it describes is known, claims its files before they appear. E0301.
    [[nodiscard]] std::vector<config::Diagnostic> commit();

  private:
    struct Staged;
    static config::Outcome<std::unique_ptr<Staged>> begin(const std::filesystem::path& path);

    std::vector<std::unique_ptr<Staged>> staged_;
};

// One file by itself, as stage and commit.
config::Outcome<WriteResult> write_file_atomically(const std::filesystem::path& path,
                                                   std::string_view bytes,
                                                   const Progress* progress = nullptr);

// Unlinks the temporaries that this process is writing now. Async-signal-safe; meant to be followed
// by _exit.
void unlink_current_temporaries() noexcept;

}  // namespace skybake
