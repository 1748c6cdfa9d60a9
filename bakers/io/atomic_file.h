// Files that are either the old ones or the new ones, whatever happens in between.
//
// The bytes go to `.NAME.skybake-PID-N.tmp` in the same folder, are flushed to the disk and renamed
// over the target. An error, an interruption or a full disk removes the temporary; what a killed
// process left behind is removed by the next write of the same file.
#pragma once

#include <filesystem>
#include <string_view>

#include "bakers/core/progress.h"
#include "config/diagnostic.h"

namespace skybake {

enum class WriteResult {
    written,
    unchanged,    // the file held these bytes already: it and its time stamp were left alone
    interrupted,  // progress->cancelled() became true: nothing was changed
};

// Writes `bytes` to `path`. An existing file keeps its permissions, a new one gets those of the
// umask. A symbolic link stays one: the file it points to is replaced. E0301 with the system's
// reason where the file cannot be written: no such folder, not permitted, read-only, disk full, a
// folder or a device of that name.
config::Outcome<WriteResult> write_file_atomically(const std::filesystem::path& path,
                                                   std::string_view bytes,
                                                   const Progress* progress = nullptr);

// Removes temporaries of `path` whose process is gone. Errors are not reported: a leftover is
// untidy, not wrong.
void remove_stale_temporaries(const std::filesystem::path& path);

// Unlinks the temporaries that this process is writing now. Async-signal-safe; meant to be followed
// by _exit.
void unlink_current_temporaries() noexcept;

}  // namespace skybake
