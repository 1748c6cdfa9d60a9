#include "bakers/io/files/output_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <thread>
#include <utility>

#include "bakers/io/files/system_call.h"
#include "bakers/io/files/temporary_file.h"
#include "bakers/io/manifest/claimed_files.h"
#include "bakers/io/manifest/journal.h"

namespace skybake {
namespace {

namespace fs = std::filesystem;

Diagnostic unwritable(const fs::path& folder, const std::string& reason) {
    return file_error(
        "E0302", folder.string(),
        fmt::format("cannot write into the folder `{}`: {}", folder.string(), reason));
}

// Returns the folder itself or, if it is missing, the nearest existing folder above it.
fs::path existing_ancestor(const fs::path& folder) {
    fs::path ancestor = fs::absolute(folder).lexically_normal();
    std::error_code error;
    while (!fs::exists(fs::symlink_status(ancestor, error)) && ancestor.has_relative_path()) {
        ancestor = ancestor.parent_path();
    }
    return ancestor;
}

// Returns what prevents files from being made in the folder, as far as that is visible without
// trying.
std::optional<Diagnostic> obstacle(const fs::path& folder, bool to_be_written) {
    const fs::path ancestor = existing_ancestor(folder);
    std::error_code error;
    const fs::file_status status = fs::status(ancestor, error);
    if (!fs::is_directory(status)) {
        const std::string reason =
            fs::exists(status) || !error ? "is not a folder" : error.message();
        return unwritable(folder, fmt::format("`{}` {}", ancestor.string(), reason));
    }
    const int wanted = to_be_written ? W_OK | X_OK : X_OK;
    if (::access(ancestor.c_str(), wanted) != 0) return unwritable(folder, system_reason(errno));
    return std::nullopt;
}

// Uses the manifest of an earlier bake. If another release wrote it, or somebody changed it, it
// only says which files are skybake's and may be overwritten. Nothing else in it is trusted.
void take_previous(std::optional<Manifest> manifest, OutputFolder& folder) {
    if (!manifest) {
        folder.previous = read_earlier_claims(folder.path);
        if (folder.previous) folder.reason = "manifest.json is of an earlier format";
    } else if (!manifest->alterations.empty()) {
        folder.previous = claims_of(*manifest);
        folder.reason = "manifest.json has been changed since the last bake";
    } else {
        folder.previous = std::move(manifest);
    }
}

enum class Attempt { taken, busy, impossible };

Attempt try_lock(int descriptor) {
    if (uninterrupted([&] { return ::flock(descriptor, LOCK_EX | LOCK_NB); }) == 0) {
        return Attempt::taken;
    }
    return errno == EWOULDBLOCK ? Attempt::busy : Attempt::impossible;
}

// Whether the folder of that name is still the one that was opened. A process that gave up may have
// removed the folder that it had made.
bool is_still(const fs::path& folder, int descriptor) {
    struct stat named {};
    struct stat opened {};
    return ::stat(folder.c_str(), &named) == 0 && ::fstat(descriptor, &opened) == 0 &&
           named.st_ino == opened.st_ino && named.st_dev == opened.st_dev;
}

// Moves the lock to a high descriptor. Linux closes the descriptors of a dying process in ascending
// order, so whoever gets the lock from a killed process finds that its temporaries are already
// unlocked. If no high descriptor is available, the lock keeps its own.
FileDescriptor closed_last(FileDescriptor descriptor) {
    if (!descriptor.valid()) return descriptor;
    constexpr int high = 512;  // of the 1024 that processes have by default
    FileDescriptor last(::fcntl(descriptor.get(), F_DUPFD_CLOEXEC, high));
    return last.valid() ? std::move(last) : std::move(descriptor);
}

}  // namespace

Diagnostic foreign_file(const fs::path& file, const std::string& why) {
    return file_error("E0303", file.string(),
                      fmt::format("`{}` already exists and {}", file.string(), why),
                      "overwrite it with --force, or choose another place");
}

Outcome<OutputFolder> inspect_output_folder(const fs::path& folder,
                                            std::span<const std::string> files, bool force,
                                            bool to_be_written) {
    if (auto diagnostic = obstacle(folder, to_be_written)) return std::move(*diagnostic);

    OutputFolder result{folder, std::nullopt, {}};
    std::error_code error;
    std::string manifest_fault = "is not a manifest of skybake";
    const bool has_manifest = fs::exists(fs::symlink_status(folder / manifest_name, error));
    if (has_manifest) {
        Outcome<Manifest> manifest = read_manifest(folder);
        if (!manifest.diagnostics.empty()) manifest_fault += ": " + manifest.diagnostics[0].message;
        take_previous(std::move(manifest.value), result);
    }
    result.is_unfinished = add_journals(folder, result.previous);
    if (force) return {std::move(result), {}};

    std::vector<Diagnostic> diagnostics;
    const ClaimedFiles claimed(result.previous.value_or(Manifest()));
    for (const std::string& file : files) {
        const fs::path path = folder / file;
        if (!fs::exists(fs::symlink_status(path, error))) continue;
        if (result.previous && claimed.hold(file)) continue;
        diagnostics.push_back(foreign_file(
            path, file == manifest_name ? manifest_fault : "no manifest there lists it"));
    }
    if (!diagnostics.empty()) return {{}, std::move(diagnostics)};
    return {std::move(result), {}};
}

Outcome<std::vector<fs::path>> create_output_folder(const fs::path& folder) {
    std::vector<fs::path> made;
    std::error_code error;
    fs::path missing = fs::absolute(folder).lexically_normal();
    while (!fs::exists(missing, error) && missing.has_relative_path()) {
        if (missing.has_filename()) made.push_back(missing);
        missing = missing.parent_path();
    }
    error.clear();
    for (const fs::path& name : made) remember_made_folder(name);
    fs::create_directories(folder, error);
    // It does not matter if another process has made the folder in the meantime.
    std::error_code ignored;
    if (error && !fs::is_directory(folder, ignored)) return unwritable(folder, error.message());
    return {std::move(made), {}};
}

void remove_empty_folders(std::span<const fs::path> folders) {
    for (const fs::path& folder : folders) {
        std::error_code not_empty;
        if (!fs::remove(folder, not_empty)) return;
    }
}

Outcome<FolderLock> FolderLock::acquire(const fs::path& folder, const std::function<void()>& waits,
                                        const std::function<bool()>& cancelled) {
    constexpr auto pause = std::chrono::milliseconds(20);
    FileDescriptor open;
    for (bool waited = false;;) {
        if (!open.valid()) {
            open = closed_last(FileDescriptor(uninterrupted(
                [&] { return ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); })));
        }
        if (!open.valid()) {
            return file_error("E0302", folder.string(),
                              fmt::format("cannot open the folder `{}`: {}", folder.string(),
                                          system_reason(errno)));
        }
        const Attempt attempt = try_lock(open.get());
        if (attempt != Attempt::busy && is_still(folder, open.get())) {
            return {FolderLock(std::move(open)), {}};
        }
        if (attempt != Attempt::busy) {
            // The folder has been removed or replaced. Opening it again gives E0302 if it was
            // removed.
            FileDescriptor gone;
            std::swap(open, gone);
            continue;
        }
        if (!waited) waits();
        waited = true;
        if (cancelled()) return {};
        std::this_thread::sleep_for(pause);
    }
}

}  // namespace skybake
