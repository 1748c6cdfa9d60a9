#include "bakers/io/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstring>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "bakers/io/file_descriptor.h"
#include "bakers/io/file_diagnostic.h"

namespace skybake {
namespace {

namespace fs = std::filesystem;

// --- What the signal handler removes ------------------------------------------------------------

// Paths lie in static memory, since a handler may neither lock nor allocate.
struct CurrentTemporary {
    enum State : int { unused, claimed, active };
    std::atomic<int> state{unused};
    std::array<char, 4096> path{};
};
static_assert(std::atomic<int>::is_always_lock_free);
std::array<CurrentTemporary, 16> current_temporaries;

// A slot of the table above; none is left if very many threads write at once, and then a second
// Ctrl-C leaves that temporary to the next run.
class Registration {
  public:
    explicit Registration(const fs::path& path) {
        if (path.native().size() >= current_temporaries[0].path.size()) return;
        for (CurrentTemporary& entry : current_temporaries) {
            int unused = CurrentTemporary::unused;
            if (!entry.state.compare_exchange_strong(unused, CurrentTemporary::claimed)) continue;
            std::memcpy(entry.path.data(), path.c_str(), path.native().size() + 1);
            entry.state = CurrentTemporary::active;
            entry_ = &entry;
            return;
        }
    }
    Registration(const Registration&) = delete;
    Registration& operator=(const Registration&) = delete;
    ~Registration() {
        if (entry_ != nullptr) entry_->state = CurrentTemporary::unused;
    }

  private:
    CurrentTemporary* entry_ = nullptr;
};

// --- Names of temporaries -----------------------------------------------------------------------

// ".NAME.skybake-"; long names are cut so that the whole stays within the 255 bytes of a name.
std::string temporary_prefix(const fs::path& path) {
    constexpr std::size_t longest_name = 200;
    return fmt::format(".{}.skybake-", path.filename().string().substr(0, longest_name));
}

constexpr std::string_view temporary_suffix = ".tmp";

// The PID of ".NAME.skybake-PID-N.tmp", or nothing for any other name.
std::optional<pid_t> temporary_owner(std::string_view name, std::string_view prefix) {
    if (name.size() <= prefix.size() + temporary_suffix.size() ||
        name.substr(0, prefix.size()) != prefix ||
        name.substr(name.size() - temporary_suffix.size()) != temporary_suffix) {
        return std::nullopt;
    }
    name = name.substr(prefix.size(), name.size() - prefix.size() - temporary_suffix.size());
    pid_t owner = 0;
    unsigned number = 0;
    const char* const end = name.data() + name.size();
    const auto pid = std::from_chars(name.data(), end, owner);
    if (pid.ec != std::errc{} || pid.ptr == end || *pid.ptr != '-' || owner <= 0)
        return std::nullopt;
    const auto count = std::from_chars(pid.ptr + 1, end, number);
    if (count.ec != std::errc{} || count.ptr != end) return std::nullopt;
    return owner;
}

// A temporary is left over if its process is gone *and* nobody holds its lock: process numbers are
// told apart by neither containers nor machines that share a folder, the lock is.
bool is_left_over(const fs::path& temporary, pid_t owner) {
    const bool alive = owner != ::getpid() && (::kill(owner, 0) == 0 || errno != ESRCH);
    if (alive) return false;
    const FileDescriptor file(
        ::open(temporary.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
    return file.valid() && ::flock(file.get(), LOCK_EX | LOCK_NB) == 0;
}

// Held while a temporary exists without its lock, so that no other thread takes it for a left-over.
std::mutex creation_mutex;

// --- Writing ------------------------------------------------------------------------------------

config::Outcome<WriteResult> failure(const fs::path& path, const std::string& reason) {
    return {{},
            {file_error("E0301", path.string(),
                        fmt::format("cannot write `{}`: {}", path.string(), reason))}};
}

config::Outcome<WriteResult> failure(const fs::path& path, int error) {
    return failure(path, system_reason(error));
}

// The file that a chain of symbolic links ends at; it need not exist.
fs::path resolve_links(const fs::path& path, std::error_code& error) {
    constexpr int longest_chain = 40;  // what Linux follows
    fs::path target = path;
    for (int i = 0; i < longest_chain; ++i) {
        std::error_code status_error;
        if (fs::symlink_status(target, status_error).type() != fs::file_type::symlink)
            return target;
        const fs::path next = fs::read_symlink(target, error);
        if (error) return target;
        target = target.parent_path() / next;  // an absolute `next` replaces the whole
    }
    error = std::make_error_code(std::errc::too_many_symbolic_link_levels);
    return target;
}

// Whether an open file holds these bytes and no more. Reads it piece by piece: no second copy.
bool holds(int descriptor, std::string_view bytes) {
    std::array<char, 65536> piece;
    std::size_t done = 0;
    while (true) {
        const ssize_t count = ::read(descriptor, piece.data(), piece.size());
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return false;
        const auto size = static_cast<std::size_t>(count);
        if (size == 0) return done == bytes.size();
        if (bytes.substr(done, size) != std::string_view(piece.data(), size)) return false;
        done += size;
    }
}

bool is_unchanged(const fs::path& path, const struct stat& status, std::string_view bytes) {
    if (static_cast<std::uintmax_t>(status.st_size) != bytes.size()) return false;
    const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    return file.valid() && holds(file.get(), bytes);
}

// A new file beside the target, locked while it exists, removed with this object unless it has
// become the target.
class Temporary {
  public:
    // errno where the file cannot be made (see valid).
    explicit Temporary(const fs::path& target) {
        static std::atomic<unsigned> counter{0};
        const std::lock_guard lock(creation_mutex);
        do {
            path_ = target.parent_path() / fmt::format("{}{}-{}{}", temporary_prefix(target),
                                                       ::getpid(), counter++, temporary_suffix);
            registration_.emplace(path_);  // first: no moment in which a signal would miss the file
            file_ = FileDescriptor(
                ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
        } while (!file_.valid() && (errno == EINTR || errno == EEXIST));
        // Where a file system has no locks the sweep finds none either, and removes nothing.
        if (file_.valid()) ::flock(file_.get(), LOCK_EX | LOCK_NB);
    }
    Temporary(const Temporary&) = delete;
    Temporary& operator=(const Temporary&) = delete;
    ~Temporary() {
        if (file_.valid() && !renamed_) ::unlink(path_.c_str());
    }
    bool valid() const { return file_.valid(); }
    int descriptor() const { return file_.get(); }
    bool rename_to(const fs::path& target) {
        renamed_ = ::rename(path_.c_str(), target.c_str()) == 0;
        return renamed_;
    }

  private:
    fs::path path_;
    std::optional<Registration> registration_;
    FileDescriptor file_;
    bool renamed_ = false;
};

bool is_cancelled(const Progress* progress) { return progress != nullptr && progress->cancelled(); }

// Writes all bytes; returns errno, 0, or ECANCELED.
int write_all(int descriptor, std::string_view bytes, const Progress* progress) {
    constexpr std::size_t piece = std::size_t{4} << 20;  // between looks at `progress`
    while (!bytes.empty()) {
        if (is_cancelled(progress)) return ECANCELED;
        const ssize_t count = ::write(descriptor, bytes.data(), std::min(bytes.size(), piece));
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return errno;
        if (count == 0) return EIO;
        bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    return is_cancelled(progress) ? ECANCELED : 0;
}

// To the disk, so that a crash after the rename does not leave an empty file under the new name,
// and so that network file systems report a full disk now.
int flush(int descriptor) {
    while (::fdatasync(descriptor) != 0) {
        if (errno == EINTR) continue;
        // Some file systems cannot, which is no reason not to write.
        return errno == EINVAL || errno == ENOTSUP || errno == ENOSYS ? 0 : errno;
    }
    return 0;
}

config::Outcome<WriteResult> replace(const fs::path& path, const fs::path& target,
                                     std::optional<mode_t> mode, std::string_view bytes,
                                     const Progress* progress) {
    Temporary temporary(target);
    if (!temporary.valid()) return failure(path, errno);
    if (mode && ::fchmod(temporary.descriptor(), *mode) != 0) return failure(path, errno);
    int error = write_all(temporary.descriptor(), bytes, progress);
    if (error == 0) error = flush(temporary.descriptor());
    if (error == ECANCELED) return {WriteResult::interrupted, {}};
    if (error != 0) return failure(path, error);
    if (!temporary.rename_to(target)) return failure(path, errno);
    return {WriteResult::written, {}};
}

}  // namespace

config::Outcome<WriteResult> write_file_atomically(const fs::path& path, std::string_view bytes,
                                                   const Progress* progress) {
    if (!path.has_filename()) return failure(path, "it is a folder");
    std::error_code link_error;
    const fs::path target = resolve_links(path, link_error);
    if (link_error) return failure(path, link_error.message());

    std::optional<mode_t> mode;
    struct stat status {};
    if (::stat(target.c_str(), &status) == 0) {
        if (S_ISDIR(status.st_mode)) return failure(path, "it is a folder");
        if (!S_ISREG(status.st_mode)) return failure(path, "it is not a regular file");
        if (is_unchanged(target, status, bytes)) return {WriteResult::unchanged, {}};
        mode = status.st_mode & 07777;
    } else if (errno != ENOENT) {
        return failure(path, errno);
    }
    remove_stale_temporaries(target);
    if (is_cancelled(progress)) return {WriteResult::interrupted, {}};
    return replace(path, target, mode, bytes, progress);
}

void remove_stale_temporaries(const fs::path& path) {
    const std::string prefix = temporary_prefix(path);
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    const std::lock_guard lock(creation_mutex);
    std::error_code error;
    std::vector<fs::path> stale;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
        const auto owner = temporary_owner(entry->path().filename().native(), prefix);
        if (owner && is_left_over(entry->path(), *owner)) stale.push_back(entry->path());
    }
    for (const fs::path& temporary : stale) ::unlink(temporary.c_str());
}

void unlink_current_temporaries() noexcept {
    for (const CurrentTemporary& entry : current_temporaries) {
        if (entry.state == CurrentTemporary::active) ::unlink(entry.path.data());
    }
}

}  // namespace skybake
