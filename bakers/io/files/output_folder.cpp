#include "bakers/io/files/output_folder.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

#include "bakers/io/files/file_diagnostic.h"

namespace skybake {
namespace {

namespace fs = std::filesystem;

config::Diagnostic unwritable(const fs::path& folder, const std::string& reason) {
    return file_error(
        "E0302", folder.string(),
        fmt::format("cannot write into the folder `{}`: {}", folder.string(), reason));
}

// The folder itself or, where it is missing, the nearest one above it that exists.
fs::path existing_ancestor(const fs::path& folder) {
    fs::path ancestor = fs::absolute(folder).lexically_normal();
    std::error_code error;
    while (!fs::exists(fs::symlink_status(ancestor, error)) && ancestor.has_relative_path()) {
        ancestor = ancestor.parent_path();
    }
    return ancestor;
}

// What keeps files from being made in the folder, as far as one can see without trying.
std::optional<config::Diagnostic> obstacle(const fs::path& folder, bool to_be_written) {
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

// A manifest that another release wrote, or that somebody has changed, says which files are
// skybake's: they may be written again. What it says of their making is not to be built on.
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

config::Diagnostic foreign(const fs::path& file, const std::string& why) {
    config::Diagnostic diagnostic = file_error(
        "E0303", file.string(), fmt::format("`{}` already exists and {}", file.string(), why));
    diagnostic.label = "overwrite it with --force, or choose another folder with -o";
    return diagnostic;
}

}  // namespace

config::Outcome<OutputFolder> inspect_output_folder(const fs::path& folder,
                                                    std::span<const std::string> files, bool force,
                                                    bool to_be_written) {
    if (auto diagnostic = obstacle(folder, to_be_written)) return {{}, {std::move(*diagnostic)}};

    OutputFolder result{folder, std::nullopt, {}};
    std::error_code error;
    std::string manifest_fault = "is not a manifest of skybake";
    const bool has_manifest = fs::exists(fs::symlink_status(folder / manifest_name, error));
    if (has_manifest) {
        config::Outcome<Manifest> manifest = read_manifest(folder);
        if (!manifest.diagnostics.empty()) manifest_fault += ": " + manifest.diagnostics[0].message;
        take_previous(std::move(manifest.value), result);
    }
    if (force) return {std::move(result), {}};

    std::vector<config::Diagnostic> diagnostics;
    for (const std::string& file : files) {
        const fs::path path = folder / file;
        if (!fs::exists(fs::symlink_status(path, error))) continue;
        if (result.previous && claims(*result.previous, file)) continue;
        diagnostics.push_back(
            foreign(path, file == manifest_name ? manifest_fault : "was not written by skybake"));
    }
    if (!diagnostics.empty()) return {{}, std::move(diagnostics)};
    return {std::move(result), {}};
}

config::Outcome<std::vector<fs::path>> create_output_folder(const fs::path& folder) {
    std::vector<fs::path> made;
    std::error_code error;
    fs::path missing = fs::absolute(folder).lexically_normal();
    while (!fs::exists(missing, error) && missing.has_relative_path()) {
        if (missing.has_filename()) made.push_back(missing);
        missing = missing.parent_path();
    }
    error.clear();
    fs::create_directories(folder, error);
    // A folder that another process made in the meantime is as good.
    std::error_code ignored;
    if (error && !fs::is_directory(folder, ignored))
        return {{}, {unwritable(folder, error.message())}};
    return {std::move(made), {}};
}

void remove_empty_folders(std::span<const fs::path> folders) {
    for (const fs::path& folder : folders) {
        std::error_code not_empty;
        if (!fs::remove(folder, not_empty)) return;
    }
}

}  // namespace skybake
