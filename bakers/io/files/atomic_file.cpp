#include "bakers/io/files/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <string>
#include <utility>

#include "bakers/io/files/file_io.h"
#include "bakers/io/files/system_call.h"
#include "bakers/io/files/temporary_file.h"

namespace skybake {
namespace {

namespace fs = std::filesystem;
using FileStatus = std::optional<struct stat>;

// Fills `bytes` as far as the file goes. Returns the number of bytes read, or nothing if it cannot
// be read.
std::optional<std::size_t> read_piece(int descriptor, std::string& bytes) {
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t count = uninterrupted(
            [&] { return ::read(descriptor, bytes.data() + done, bytes.size() - done); });
        if (count < 0) return std::nullopt;
        if (count == 0) break;
        done += static_cast<std::size_t>(count);
    }
    return done;
}

// Whether an open file holds exactly these bytes. Reads it piece by piece, to avoid a second copy.
bool holds(int descriptor, std::string_view bytes) {
    std::string piece(65536, '\0');
    std::size_t done = 0;
    while (true) {
        const auto count = read_piece(descriptor, piece);
        if (!count) return false;
        if (*count == 0) return done == bytes.size();
        if (bytes.substr(done, *count) != std::string_view(piece).substr(0, *count)) return false;
        done += *count;
    }
}

FileDescriptor opened_to_read(const fs::path& path, int flags) {
    return FileDescriptor(
        uninterrupted([&] { return ::open(path.c_str(), O_RDONLY | O_CLOEXEC | flags); }));
}

bool is_unchanged(const fs::path& path, const struct stat& status, std::string_view bytes) {
    if (static_cast<std::uintmax_t>(status.st_size) != bytes.size()) return false;
    const FileDescriptor file = opened_to_read(path, O_NOFOLLOW);
    return file.valid() && holds(file.get(), bytes);
}

int flush_by(int (*call)(int), int descriptor) {
    if (uninterrupted([&] { return call(descriptor); }) == 0) return 0;
    return errno == EINVAL || errno == ENOTSUP || errno == ENOSYS ? 0 : errno;
}

// Gives the temporary the permissions of the old file. This happens after writing, because they may
// forbid writing. The owner can always read the file, because the next bake must read it. Returns
// errno, or 0.
int keep_mode(const TemporaryFile& temporary, const FileStatus& old) {
    if (!old) return 0;
    const mode_t mode = (old->st_mode & 07777) | S_IRUSR;
    return uninterrupted([&] { return ::fchmod(temporary.descriptor(), mode); }) == 0 ? 0 : errno;
}

// Whether a link leads to a device or to an open file of a process, as /dev/stdout does. Such names
// belong to the system.
bool belongs_to_system(const fs::path& link) {
    std::error_code error;
    const std::string target = fs::read_symlink(link, error).string();
    return target.rfind("/dev/", 0) == 0 || target.rfind("/proc/", 0) == 0;
}

// Returns the status of the regular file that a file of this name would replace. Returns an empty
// status if there is no file, or only a symbolic link, whose target does not matter.
Outcome<FileStatus> find_old(const fs::path& path) {
    if (!path.has_filename()) return cannot_write(path, "it is a folder");
    struct stat status {};
    if (::lstat(path.c_str(), &status) != 0) {
        if (errno != ENOENT) return cannot_write(path, system_reason(errno));
        return {FileStatus(), {}};
    }
    if (S_ISLNK(status.st_mode)) {
        if (belongs_to_system(path))
            return cannot_write(path, "it is a link to a device or an open file");
        return {FileStatus(), {}};
    }
    if (S_ISDIR(status.st_mode)) return cannot_write(path, "it is a folder");
    if (!S_ISREG(status.st_mode)) return cannot_write(path, "it is not a regular file");
    return {FileStatus(status), {}};
}

// Whether two files hold the same bytes. Returns false also if one cannot be read or on
// interruption.
bool same_bytes(const fs::path& first, const fs::path& second, const Progress* progress) {
    constexpr std::size_t piece = std::size_t{1} << 20;
    const FileDescriptor a = opened_to_read(first, O_NOFOLLOW);
    const FileDescriptor b = opened_to_read(second, 0);
    if (!a.valid() || !b.valid()) return false;
    std::string bytes(piece, '\0');
    std::string others(piece, '\0');
    while (!is_cancelled(progress)) {
        const auto count = read_piece(a.get(), bytes);
        const auto other_count = read_piece(b.get(), others);
        if (!count || count != other_count) return false;
        if (*count == 0) return true;
        if (std::string_view(bytes).substr(0, *count) !=
            std::string_view(others).substr(0, *count)) {
            return false;
        }
    }
    return false;
}

// Replaces the temporary's name in a text, because people know the file by its own name.
void rename_in_text(std::string& text, const std::string& temporary, const std::string& name) {
    for (std::size_t at = text.find(temporary); at != std::string::npos;
         at = text.find(temporary, at + name.size())) {
        text.replace(at, temporary.size(), name);
    }
}

std::atomic<int> commits_in_progress{0};
static_assert(std::atomic<int>::is_always_lock_free);  // a signal handler reads it

struct CommitInProgress {
    CommitInProgress() { ++commits_in_progress; }
    CommitInProgress(const CommitInProgress&) = delete;
    CommitInProgress& operator=(const CommitInProgress&) = delete;
    ~CommitInProgress() { --commits_in_progress; }
};

}  // namespace

struct AtomicFiles::Staged {
    explicit Staged(fs::path path_) : path(std::move(path_)), temporary(path) {}

    fs::path path;
    TemporaryFile temporary;
};

AtomicFiles::AtomicFiles(LeftOvers left_overs) : left_overs_(left_overs) {}
AtomicFiles::~AtomicFiles() = default;

Outcome<WriteResult> AtomicFiles::stage(const fs::path& path, std::string_view bytes,
                                        const Progress* progress) {
    const Outcome<FileStatus> old = find_old(path);
    if (old.value && *old.value && is_unchanged(path, **old.value, bytes)) {
        if (left_overs_ == LeftOvers::to_be_removed) remove_stale_temporaries(path);
        return {WriteResult::unchanged, {}};
    }
    const auto write = [bytes](const fs::path& temporary) {
        FileOutput output(temporary);
        output.write(bytes);
        return output.finished(true);
    };
    return stage(path, write, progress);
}

Outcome<WriteResult> AtomicFiles::stage(const fs::path& path, const FileWriter& write,
                                        const Progress* progress) {
    const Outcome<FileStatus> found = find_old(path);
    if (!found.value) return {{}, found.diagnostics};
    const FileStatus& old = *found.value;
    if (left_overs_ == LeftOvers::to_be_removed) remove_stale_temporaries(path);
    if (is_cancelled(progress)) return {WriteResult::interrupted, {}};
    auto staged = std::make_unique<Staged>(path);
    const TemporaryFile& temporary = staged->temporary;
    if (!temporary.valid()) return cannot_write(path, system_reason(errno));
    Outcome<bool> written = write(temporary.path());
    for (Diagnostic& diagnostic : written.diagnostics) {
        rename_in_text(diagnostic.message, temporary.path().string(), path.string());
        rename_in_text(diagnostic.where.source, temporary.path().string(), path.string());
    }
    if (!written.value) return {{}, std::move(written.diagnostics)};
    if (!*written.value || is_cancelled(progress)) return {WriteResult::interrupted, {}};
    if (const int error = flush_data(temporary.descriptor()))
        return cannot_write(path, system_reason(error));
    if (old && same_bytes(path, temporary.path(), progress)) {
        return {WriteResult::unchanged, std::move(written.diagnostics)};
    }
    if (is_cancelled(progress)) return {WriteResult::interrupted, {}};
    if (const int error = keep_mode(temporary, old))
        return cannot_write(path, system_reason(error));
    // The first file and the last stay open, because their locks show other processes that this one lives:
    // the first until it is renamed, and the last while the others are.
    if (staged_.size() > 1) staged_.back()->temporary.close();
    staged_.push_back(std::move(staged));
    return {WriteResult::written, std::move(written.diagnostics)};
}

void AtomicFiles::shrink(std::size_t count) { staged_.resize(std::min(count, staged_.size())); }

int flush_data(int descriptor) { return flush_by(&::fdatasync, descriptor); }

int flush_folder(const fs::path& folder) {
    const FileDescriptor opened = opened_to_read(folder.empty() ? "." : folder, O_DIRECTORY);
    return opened.valid() ? flush_by(&::fsync, opened.get()) : 0;
}

bool is_renaming_files() noexcept { return commits_in_progress > 0; }

std::vector<Diagnostic> AtomicFiles::commit() {
    const CommitInProgress in_progress;
    std::size_t named = 0;
    int error = 0;
    for (; named < staged_.size() && error == 0; named += error == 0 ? 1 : 0) {
        Staged& next = *staged_[named];
        const bool is_last_of_several = named > 0 && named + 1 == staged_.size();
        if (is_last_of_several) error = flush_folder(next.path.parent_path());
        if (error == 0 && !next.temporary.rename_to(next.path)) error = errno;
    }
    if (error == 0 && named > 0) error = flush_folder(staged_.back()->path.parent_path());
    std::vector<Diagnostic> failures;
    if (error != 0) {
        failures = {
            cannot_write(staged_[std::min(named, staged_.size() - 1)]->path, system_reason(error))};
    }
    staged_.erase(staged_.begin(), staged_.begin() + static_cast<std::ptrdiff_t>(named));
    return failures;
}

Outcome<WriteResult> write_file_atomically(const fs::path& path, std::string_view bytes,
                                           const Progress* progress) {
    AtomicFiles files;
    Outcome<WriteResult> result = files.stage(path, bytes, progress);
    if (!result.value) return result;
    std::vector<Diagnostic> diagnostics = files.commit();
    if (!diagnostics.empty()) return {{}, std::move(diagnostics)};
    return result;
}

}  // namespace skybake
