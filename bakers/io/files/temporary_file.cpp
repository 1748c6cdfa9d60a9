#include "bakers/io/files/temporary_file.h"

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
#include <cstring>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "bakers/io/files/atomic_file.h"
#include "bakers/io/files/system_call.h"
#include "bakers/io/manifest/manifest.h"

namespace skybake {
namespace {

namespace fs = std::filesystem;

// --- What the signal handler removes ------------------------------------------------------------

// The paths are in static memory, because a signal handler must neither lock nor allocate.
struct CurrentPath {
    enum State : int { unused, claimed, active };
    std::atomic<int> state{unused};
    std::array<char, 4096> path{};
};
static_assert(std::atomic<int>::is_always_lock_free);
std::array<CurrentPath, 64> current_temporaries;
std::array<CurrentPath, 16> made_folders;

// Returns a slot of the table, or -1 if none is left, because very many files are being written or
// very many folders were made. Then a process that ends at once leaves that path to the next run.
int enter(std::span<CurrentPath> table, const fs::path& path) {
    if (path.native().size() >= table[0].path.size()) return -1;
    for (std::size_t i = 0; i < table.size(); ++i) {
        CurrentPath& entry = table[i];
        int unused = CurrentPath::unused;
        if (!entry.state.compare_exchange_strong(unused, CurrentPath::claimed)) continue;
        std::memcpy(entry.path.data(), path.c_str(), path.native().size() + 1);
        entry.state = CurrentPath::active;
        return static_cast<int>(i);
    }
    return -1;
}

void leave(int slot) {
    if (slot >= 0) current_temporaries[static_cast<std::size_t>(slot)].state = CurrentPath::unused;
}

// --- Names of temporaries -----------------------------------------------------------------------

constexpr std::string_view temporary_mark = ".skybake-";

// Returns ".NAME.skybake-". Long names are cut so that the temporary's name stays within 255 bytes.
std::string temporary_prefix(const fs::path& path) {
    constexpr std::size_t longest_name = 200;
    return fmt::format(".{}{}", path.filename().string().substr(0, longest_name), temporary_mark);
}

constexpr std::string_view temporary_suffix = ".tmp";

// Returns the process number of ".NAME.skybake-PID-N.tmp", or 0 if the name is another.
pid_t owner_of(std::string_view name, std::string_view prefix) {
    if (name.size() <= prefix.size() + temporary_suffix.size() || !name.starts_with(prefix) ||
        !name.ends_with(temporary_suffix)) {
        return 0;
    }
    name = name.substr(prefix.size(), name.size() - prefix.size() - temporary_suffix.size());
    pid_t owner = 0;
    unsigned number = 0;
    const char* const end = name.data() + name.size();
    const auto pid = std::from_chars(name.data(), end, owner);
    if (pid.ec != std::errc{} || pid.ptr == end || *pid.ptr != '-' || owner <= 0) return 0;
    const auto count = std::from_chars(pid.ptr + 1, end, number);
    return count.ec == std::errc{} && count.ptr == end ? owner : 0;
}

// Returns a descriptor that holds the lock of a temporary, or none if somebody else holds it.
FileDescriptor locked(const fs::path& temporary) {
    FileDescriptor file(uninterrupted(
        [&] { return ::open(temporary.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK); }));
    const bool taken =
        file.valid() && uninterrupted([&] { return ::flock(file.get(), LOCK_EX | LOCK_NB); }) == 0;
    return taken ? std::move(file) : FileDescriptor();
}

// Locks a temporary that has just been made. Returns false if another process has mistaken it for a
// leftover in the meantime: it holds the lock, or the name is gone. On file systems without locks,
// leftovers are never removed, so this returns true.
bool lock_unless_removed(int descriptor) {
    if (uninterrupted([&] { return ::flock(descriptor, LOCK_EX | LOCK_NB); }) != 0) {
        return errno != EWOULDBLOCK;
    }
    struct stat status {};
    return ::fstat(descriptor, &status) != 0 || status.st_nlink > 0;
}

// Returns what a name would begin with if it were that of a temporary.
std::string own_prefix(const std::string& name) {
    const std::size_t mark = name.rfind(temporary_mark);
    if (mark == std::string::npos || name[0] != '.') return name;
    return name.substr(0, mark + temporary_mark.size());
}

using PrefixFor = std::function<std::string(const std::string& name)>;

// Returns the temporaries in a folder, each with its process number.
std::vector<std::pair<fs::path, pid_t>> temporaries_in(const fs::path& folder,
                                                       const PrefixFor& prefix_for) {
    std::error_code error;
    std::vector<std::pair<fs::path, pid_t>> found;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
        const std::string name = entry->path().filename().native();
        const pid_t owner = owner_of(name, prefix_for(name));
        if (owner != 0) found.emplace_back(entry->path(), owner);
    }
    return found;
}

// Whether somebody holds the lock of any temporary of a process but this one.
bool holds_another(const fs::path& folder, pid_t owner, const fs::path& but) {
    const auto all = temporaries_in(folder, own_prefix);
    return std::ranges::any_of(all, [&](const auto& other) {
        std::error_code gone;
        return other.second == owner && other.first != but && !locked(other.first).valid() &&
               fs::exists(other.first, gone);
    });
}

// Removes temporaries whose process is gone: nobody holds their lock or that of another one of the
// same process. The process number alone cannot tell this: a process that is being killed, or that
// its parent has not waited for, still has its number; another process may have it by now; and
// numbers are not unique across containers or machines that share a folder.
void remove_stale(const fs::path& folder, const PrefixFor& prefix_for) {
    std::map<pid_t, bool> lives;
    for (const auto& [temporary, owner] : temporaries_in(folder, prefix_for)) {
        const FileDescriptor file = locked(temporary);
        if (!file.valid()) continue;
        const auto [known, is_new] = lives.try_emplace(owner);
        if (is_new) known->second = holds_another(folder, owner, temporary);
        if (!known->second) ::unlink(temporary.c_str());
    }
}

fs::path folder_of(const fs::path& target) {
    return target.has_parent_path() ? target.parent_path() : fs::path(".");
}

}  // namespace

TemporaryFile::TemporaryFile(const fs::path& target) {
    static std::atomic<unsigned> counter{0};
    do {
        leave(slot_);
        path_ = target.parent_path() / fmt::format("{}{}-{}{}", temporary_prefix(target),
                                                   ::getpid(), counter++, temporary_suffix);
        slot_ = enter(current_temporaries,
                      path_);  // entered before opening, so that a signal never misses the file
        file_ =
            FileDescriptor(::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    } while (file_.valid() ? !lock_unless_removed(file_.get()) : errno == EINTR || errno == EEXIST);
    made_ = file_.valid();
}

TemporaryFile::~TemporaryFile() {
    if (made_) ::unlink(path_.c_str());
    leave(slot_);
}

void TemporaryFile::leave_behind() {
    leave(std::exchange(slot_, -1));
    made_ = false;
}

bool TemporaryFile::rename_to(const fs::path& target) {
    const bool renamed =
        uninterrupted([&] { return ::rename(path_.c_str(), target.c_str()); }) == 0;
    if (renamed) made_ = false;
    return renamed;
}

void remove_stale_temporaries(const fs::path& target) {
    remove_stale(folder_of(target),
                 [prefix = temporary_prefix(target)](const std::string&) { return prefix; });
}

void remove_stale_temporaries_in(const fs::path& folder) {
    const std::string kept = temporary_prefix(manifest_name);
    remove_stale(folder, [&kept](const std::string& name) {
        const std::string prefix = own_prefix(name);
        return prefix == kept ? name : prefix;
    });
}

std::vector<fs::path> temporaries_of(const fs::path& target) {
    const auto prefix_for = [prefix = temporary_prefix(target)](const std::string&) {
        return prefix;
    };
    std::vector<fs::path> paths;
    for (const auto& [path, owner] : temporaries_in(folder_of(target), prefix_for)) {
        paths.push_back(path);
    }
    return paths;
}

void remember_made_folder(const fs::path& folder) { enter(made_folders, folder); }

void remove_unfinished_files() noexcept {
    for (const CurrentPath& entry : current_temporaries) {
        if (entry.state == CurrentPath::active) ::unlink(entry.path.data());
    }
    for (const CurrentPath& entry : made_folders) {
        if (entry.state == CurrentPath::active) ::rmdir(entry.path.data());
    }
}

}  // namespace skybake
