#include "bakers/workspace/cache_folder.h"

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <memory>

#include "bakers/io/files/atomic_file.h"
#include "bakers/io/files/system_call.h"
#include "bakers/io/manifest/release.h"
#include "bakers/math/hash.h"
#include "bakers/workspace/asset_cache.h"
#include "bakers/workspace/folder_plan.h"

namespace skybake {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTagName = "CACHEDIR.TAG";
constexpr std::string_view kTagText =
    "Signature: 8a477f597d28d172789f06886806bc55\n"
    "# This folder holds assets that skybake can bake again.\n";

// Returns the names in an open folder, or none if it cannot be read.
std::vector<std::string> names_in(int folder) {
    std::vector<std::string> names;
    const int copy =
        uninterrupted([&] { return ::openat(folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC); });
    const std::unique_ptr<DIR, int (*)(DIR*)> listed(copy >= 0 ? ::fdopendir(copy) : nullptr,
                                                     &::closedir);
    if (!listed) {
        if (copy >= 0) ::close(copy);
        return names;
    }
    while (const dirent* entry = ::readdir(listed.get())) {
        const std::string_view name = entry->d_name;
        if (name != "." && name != "..") names.emplace_back(name);
    }
    return names;
}

FileDescriptor real_folder_in(int parent, const char* name) {
    return FileDescriptor(uninterrupted(
        [&] { return ::openat(parent, name, O_RDONLY | O_DIRECTORY | O_CLOEXEC | O_NOFOLLOW); }));
}

FileDescriptor folder_at(const fs::path& path) {
    return FileDescriptor(
        uninterrupted([&] { return ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); }));
}

// Removes what an open folder holds. Symbolic links are removed and not followed.
void empty_folder(int folder) {
    for (const std::string& name : names_in(folder)) {
        if (::unlinkat(folder, name.c_str(), 0) == 0) continue;
        const FileDescriptor inner = real_folder_in(folder, name.c_str());
        if (!inner.valid()) continue;
        empty_folder(inner.get());
        ::unlinkat(folder, name.c_str(), AT_REMOVEDIR);
    }
}

// Whether the name is PID-N.
bool is_pending_name(std::string_view name) {
    constexpr std::string_view digits = "0123456789";
    const std::size_t dash = name.find_first_not_of(digits);
    return dash != 0 && dash < name.size() && name[dash] == '-' && dash + 1 < name.size() &&
           name.find_first_not_of(digits, dash + 1) == std::string_view::npos;
}

// Whether nothing stands there but a tag that another process is writing. A folder that cannot be read
// may be a cache; whoever uses it finds out.
bool may_become_a_cache(const fs::path& folder) {
    const std::string unfinished = fmt::format(".{}.", kTagName);
    const FileDescriptor opened = folder_at(folder);
    if (!opened.valid()) return errno != ENOTDIR;
    for (const std::string& name : names_in(opened.get())) {
        if (!name.starts_with(unfinished)) return false;
    }
    return true;
}

AssetIdentity identity_of(const KeptBytes::Name& name) {
    AssetIdentity identity;
    identity.kind = name.kind;
    identity.release = release();
    identity.baker_version = name.version;
    identity.parameters = name.parameters;
    identity.key = key_of(identity);
    return identity;
}

// The entry of a manifest has the form of an asset's: a table without channels.
ManifestAsset entry_of(const KeptBytes::Name& name, std::string_view bytes) {
    ManifestAsset entry;
    entry.name = name.kind;
    entry.kind = name.kind;
    entry.content = "what assets are made from";
    entry.release = release();
    entry.axes.resize(2);
    entry.size = {1, 1};
    entry.levels.emplace_back().size = {1, 1, 1};
    entry.files.emplace_back();
    entry.files[0].path = name.kind;
    entry.files[0].format = "bin";
    entry.files[0].compression = "none";
    entry.files[0].bytes = bytes.size();
    entry.files[0].xxh3 = xxh3_hex(bytes);
    entry.parameters = name.parameters;
    sign(identity_of(name), entry);
    return entry;
}

}  // namespace

bool is_cache_folder(const fs::path& folder) {
    constexpr std::uintmax_t longest = 4096;
    const auto text = read_file(folder / kTagName, longest);
    const std::string_view signature = kTagText.substr(0, kTagText.find('\n'));
    return text.value && text.value->starts_with(signature) &&
           text.value->find("skybake") != std::string::npos;
}

std::vector<Diagnostic> check_cache_folder(const fs::path& folder) {
    // The tag is looked for a second time because another process may write it in the meantime.
    if (is_cache_folder(folder) || may_become_a_cache(folder) || is_cache_folder(folder)) return {};
    return {file_error(
        "E0302", folder.string(),
        fmt::format("`{}` is not a cache: it is no empty folder, and holds no {} of skybake",
                    folder.string(), kTagName),
        "choose another folder, which is made or may be empty")};
}

std::vector<Diagnostic> make_cache_folder(const fs::path& folder) {
    if (is_cache_folder(folder)) return {};
    if (auto problems = check_cache_folder(folder); !problems.empty()) return problems;
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) {
        return {file_error("E0301", folder.string(),
                           fmt::format("cannot write `{}`: {}", folder.string(), error.message()))};
    }
    return write_file_atomically(folder / kTagName, kTagText).diagnostics;
}

FileDescriptor group_folder(const fs::path& cache, const std::string& key, bool make) {
    FileDescriptor folder = folder_at(cache);
    for (const std::string& name : {std::string("assets"), key.substr(0, 2)}) {
        if (!folder.valid()) break;
        if (make) ::mkdirat(folder.get(), name.c_str(), 0777);
        folder = real_folder_in(folder.get(), name.c_str());
    }
    return folder;
}

PendingFolder::PendingFolder(const fs::path& cache, std::error_code& error) {
    static std::atomic<unsigned> counter{0};
    const fs::path parent = cache / "pending";
    fs::create_directory(parent, error);
    if (!error && !fs::is_directory(fs::symlink_status(parent, error))) {
        error = std::make_error_code(std::errc::not_a_directory);
    }
    // Processes in other containers and on other machines may have the same number as this one.
    for (bool is_own = false; !error && !is_own;) {
        path_ = parent / fmt::format("{}-{}", ::getpid(), counter++);
        is_own = fs::create_directory(path_, error) && lock();
    }
    if (error) path_.clear();
}

PendingFolder::~PendingFolder() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
}

// Returns false if another process has mistaken the new folder for an abandoned one in the meantime:
// it holds the lock, or the folder is gone. Without locks, no folder counts as abandoned.
bool PendingFolder::lock() {
    lock_ = folder_at(path_);
    if (!lock_.valid()) return errno != ENOENT;
    if (uninterrupted([&] { return ::flock(lock_.get(), LOCK_EX | LOCK_NB); }) != 0) {
        return errno != EWOULDBLOCK;
    }
    struct stat named {};
    struct stat opened {};
    return ::lstat(path_.c_str(), &named) == 0 && ::fstat(lock_.get(), &opened) == 0 &&
           named.st_ino == opened.st_ino && named.st_dev == opened.st_dev;
}

void remove_abandoned(const fs::path& cache) {
    if (!is_cache_folder(cache)) return;
    const FileDescriptor root = folder_at(cache);
    const FileDescriptor pending = real_folder_in(root.get(), "pending");
    if (!pending.valid()) return;
    for (const std::string& name : names_in(pending.get())) {
        if (!is_pending_name(name)) continue;
        const FileDescriptor folder = real_folder_in(pending.get(), name.c_str());
        struct stat status {};
        if (!folder.valid() || ::fstat(folder.get(), &status) != 0) continue;
        if (status.st_uid != ::geteuid() || ::flock(folder.get(), LOCK_EX | LOCK_NB) != 0) continue;
        empty_folder(folder.get());
        ::unlinkat(pending.get(), name.c_str(), AT_REMOVEDIR);
    }
}

std::optional<std::string> CachedBytes::find(const Name& name) {
    AssetCache cache(cache_);
    const auto ready = cache.find(identity_of(name).key);
    if (!ready || ready->entry.files.size() != 1) return std::nullopt;
    const ManifestFile& file = ready->entry.files[0];
    auto bytes = read_file(ready->folder / file.path, file.bytes);
    if (bytes.value && xxh3_hex(*bytes.value) == file.xxh3) return std::move(*bytes.value);
    cache.reject(*ready);
    return std::nullopt;
}

std::vector<Diagnostic> CachedBytes::offer(const Name& name, std::string_view bytes) {
    if (cache_.empty()) return {};
    AssetCache cache(cache_);
    cache.offer(bytes, entry_of(name, bytes));
    return cache.problems();
}

}  // namespace skybake
