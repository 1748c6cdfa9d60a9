#include "bakers/workspace/asset_cache.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

#include "bakers/field/baked.h"
#include "bakers/io/files/file_io.h"
#include "bakers/io/files/system_call.h"
#include "bakers/io/manifest/asset_files.h"
#include "bakers/io/manifest/release.h"
#include "bakers/workspace/cache_folder.h"

namespace skybake {
namespace {

namespace fs = std::filesystem;

fs::path assets_folder(const fs::path& cache) { return cache / "assets"; }

fs::path entry_folder(const fs::path& cache, const std::string& key) {
    return assets_folder(cache) / key.substr(0, 2) / key;
}

// A progress that is never cancelled. A copy into the cache is short compared with the bake that it
// saves.
class Unhurried : public Progress {
  public:
    void advance(std::string_view, double) override {}
    bool cancelled() const override { return false; }
};

Diagnostic unwritable(const fs::path& path, const std::string& reason) {
    return file_error("E0301", path.string(),
                      fmt::format("cannot write `{}`: {}", path.string(), reason));
}

// A folder that is open, and a path in it; with AT_FDCWD, any path.
struct PathIn {
    int folder = AT_FDCWD;
    fs::path path;
};

std::error_code renamed(const PathIn& from, const PathIn& to) {
    const bool done =
        uninterrupted([&] {
            return ::renameat(from.folder, from.path.c_str(), to.folder, to.path.c_str());
        }) == 0;
    return {done ? 0 : errno, std::generic_category()};
}

// Gives a complete folder of `pending` its name.
std::vector<Diagnostic> take_in(const fs::path& cache, const fs::path& pending,
                                const std::string& key) {
    const FileDescriptor group = group_folder(cache, key, true);
    const fs::path target = entry_folder(cache, key);
    if (!group.valid()) return {unwritable(target, std::generic_category().message(errno))};
    std::error_code error;
    if (fs::is_symlink(target, error)) fs::remove(target, error);  // one that leads nowhere
    error = renamed({.path = pending}, {group.get(), key});
    // If another process was faster, its entry holds the same bytes.
    if (error && !fs::exists(target)) return {unwritable(target, error.message())};
    return {};
}

// Removes an entry: moves it to `pending` at once, then removes it file by file.
std::vector<Diagnostic> remove_entry(const fs::path& cache, const std::string& key) {
    const FileDescriptor group = group_folder(cache, key, false);
    if (!group.valid()) return {};
    std::error_code error;
    const PendingFolder pending(cache, error);
    if (!error) error = renamed({group.get(), key}, {.path = pending.path() / "entry"});
    const fs::path entry = entry_folder(cache, key);
    if (error && fs::exists(entry)) return {unwritable(entry, error.message())};
    return {};
}

template <class Staged>
std::vector<Diagnostic> failures_of(Outcome<Staged> staged) {
    return staged.value ? std::vector<Diagnostic>{} : std::move(staged.diagnostics);
}

CacheEntry describe(const fs::path& folder) {
    CacheEntry entry;
    entry.folder = folder;
    entry.key = folder.filename().string();
    std::error_code error;
    for (fs::directory_iterator file(folder, error), end; !error && file != end;
         file.increment(error)) {
        std::error_code gone;
        const auto bytes = fs::file_size(file->path(), gone);
        if (!gone) entry.bytes += bytes;
    }
    struct stat status {};
    if (::lstat((folder / manifest_name).c_str(), &status) == 0) {
        entry.last_use_s = status.st_mtim.tv_sec;
    }
    const auto manifest = read_manifest(folder);
    if (manifest.value && manifest.value->assets.size() == 1) {
        entry.kind = manifest.value->assets[0].kind;
    }
    return entry;
}

bool is_damage(const std::vector<Diagnostic>& diagnostics) {
    return std::ranges::any_of(
        diagnostics, [](const Diagnostic& diagnostic) { return diagnostic.code == "E0304"; });
}

// Returns the files of an entry that differ from its manifest, or the manifest itself if it is
// damaged.
std::vector<fs::path> damages(const CacheEntry& entry) {
    const auto manifest = read_manifest(entry.folder);
    if (!manifest.value || !is_entry_of(*manifest.value, entry.key)) {
        return {entry.folder / manifest_name};
    }
    std::vector<fs::path> damaged;
    for (const ManifestFile& file : manifest.value->assets[0].files) {
        const auto print = fingerprint(entry.folder / file.path);
        if (!print.value || print.value->xxh3 != file.xxh3) {
            damaged.push_back(entry.folder / file.path);
        }
    }
    return damaged;
}

}  // namespace

bool is_key(std::string_view key) {
    return key.size() == 32 && key.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

std::string cached_manifest_json(const ManifestAsset& entry) {
    Manifest manifest;
    manifest.tool_name = tool_name();
    manifest.tool_version = entry.release;
    manifest.assets = {entry};
    return manifest_json(manifest);
}

bool is_entry_of(const Manifest& manifest, const std::string& key) {
    return manifest.alterations.empty() && manifest.assets.size() == 1 &&
           manifest.assets[0].key == key;
}

std::optional<ReadyAsset> AssetCache::find(const std::string& key) {
    if (!is_key(key) || !is_cache_folder(folder_)) return std::nullopt;
    if (!group_folder(folder_, key, false).valid()) return std::nullopt;
    const fs::path folder = entry_folder(folder_, key);
    std::error_code error;
    if (!fs::exists(folder, error)) return std::nullopt;
    const auto manifest = read_manifest(folder);
    if (!manifest.value || !is_entry_of(*manifest.value, key)) {
        // A damaged entry is removed to make room for a good one. An entry that cannot be read now
        // may still be good.
        if (manifest.value || is_damage(manifest.diagnostics)) remove_entry(folder_, key);
        return std::nullopt;
    }
    // Records the last use. It may fail, because a read-only cache can be used as well.
    ::utimensat(AT_FDCWD, (folder / manifest_name).c_str(), nullptr, AT_SYMLINK_NOFOLLOW);
    return ReadyAsset{folder, manifest.value->assets[0]};
}

void AssetCache::reject(const ReadyAsset& asset) {
    remove_entry(folder_, asset.folder.filename().string());
}

void AssetCache::offer(const ReadyAsset& asset) {
    keep(asset.entry, [&asset](const fs::path& folder, AtomicFiles& files) {
        return failures_of(stage_copies(asset, folder, files, Unhurried()));
    });
}

void AssetCache::offer(const Baked& baked, ManifestAsset entry, int threads) {
    keep(entry, [&](const fs::path& folder, AtomicFiles& files) {
        return failures_of(stage_files(baked, entry, folder, files, threads));
    });
}

void AssetCache::offer(std::string_view bytes, const ManifestAsset& entry) {
    keep(entry, [&](const fs::path& folder, AtomicFiles& files) {
        return failures_of(files.stage(folder / entry.files.at(0).path, bytes));
    });
}

void AssetCache::keep(const ManifestAsset& entry, const StageAsset& stage) {
    const std::string& key = entry.key;
    if (!std::exchange(tidied_, true)) remove_abandoned(folder_);
    std::error_code error;
    if (!is_key(key) || fs::exists(entry_folder(folder_, key), error)) return;
    const auto store = [&]() -> std::vector<Diagnostic> {
        if (auto problems = make_cache_folder(folder_); !problems.empty()) return problems;
        const PendingFolder pending(folder_, error);
        if (error) return {unwritable(folder_ / "pending", error.message())};
        AtomicFiles files;
        if (auto failures = stage(pending.path(), files); !failures.empty()) return failures;
        const std::string text = cached_manifest_json(entry);
        const auto manifest = files.stage(pending.path() / manifest_name, std::string_view(text));
        if (!manifest.value) return manifest.diagnostics;
        if (auto failures = files.commit(); !failures.empty()) return failures;
        return take_in(folder_, pending.path(), key);
    };
    const auto problems = store();
    if (problems.empty()) ++kept_;
    for (const Diagnostic& problem : problems) {
        Diagnostic warning = problem;
        warning.severity = Severity::warning;
        warning.code = "W0301";
        warning.message = "the cache could not keep this asset: " + problem.message;
        if (problems_.empty()) problems_.push_back(std::move(warning));
    }
}

Outcome<std::vector<CacheEntry>> cache_entries(const fs::path& folder) {
    if (auto problems = check_cache_folder(folder); !problems.empty()) {
        return {{}, std::move(problems)};
    }
    std::vector<CacheEntry> entries;
    std::error_code error;
    for (fs::directory_iterator group(assets_folder(folder), error), end; !error && group != end;
         group.increment(error)) {
        const std::string prefix = group->path().filename().string();
        if (prefix.size() != 2 || !group_folder(folder, prefix, false).valid()) continue;
        for (fs::directory_iterator entry(group->path(), error); !error && entry != end;
             entry.increment(error)) {
            const std::string key = entry->path().filename().string();
            if (is_key(key) && key.starts_with(prefix)) entries.push_back(describe(entry->path()));
        }
    }
    if (error && error != std::errc::no_such_file_or_directory) {
        return file_error(
            "E0300", folder.string(),
            fmt::format("cannot read the cache `{}`: {}", folder.string(), error.message()));
    }
    std::ranges::sort(entries, [](const CacheEntry& a, const CacheEntry& b) {
        return std::pair(a.last_use_s, a.key) < std::pair(b.last_use_s, b.key);
    });
    return {std::move(entries), {}};
}

Outcome<std::vector<CacheEntry>> collect_garbage(const fs::path& folder,
                                                 std::uint64_t largest_bytes) {
    auto entries = cache_entries(folder);
    if (!entries.value) return entries;
    remove_abandoned(folder);
    std::uint64_t bytes = 0;
    for (const CacheEntry& entry : *entries.value) bytes += entry.bytes;
    std::vector<CacheEntry> removed;
    for (const CacheEntry& entry : *entries.value) {
        if (bytes <= largest_bytes) break;
        auto problems = remove_entry(folder, entry.key);
        if (!problems.empty()) return {{}, std::move(problems)};
        bytes -= entry.bytes;
        removed.push_back(entry);
    }
    return {std::move(removed), {}};
}

Outcome<CacheVerification> verify_cache(const fs::path& folder) {
    auto entries = cache_entries(folder);
    if (!entries.value) return {{}, std::move(entries.diagnostics)};
    CacheVerification verification;
    for (const CacheEntry& entry : *entries.value) {
        ++verification.entries;
        const std::vector<fs::path> damaged = damages(entry);
        if (damaged.empty()) continue;
        verification.damaged.insert(verification.damaged.end(), damaged.begin(), damaged.end());
        auto problems = remove_entry(folder, entry.key);
        if (!problems.empty()) return {{}, std::move(problems)};
    }
    return {std::move(verification), {}};
}

}  // namespace skybake
