#include "bakers/preview/load_assets.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "bakers/assets/registry.h"
#include "bakers/io/files/file_diagnostic.h"
#include "bakers/io/files/file_input.h"
#include "bakers/io/files/spelling.h"
#include "bakers/io/formats/exr/exr.h"
#include "bakers/io/formats/read_volume.h"
#include "bakers/io/manifest/manifest.h"
#include "bakers/io/manifest/recorded_recipe.h"
#include "bakers/preview/file_metadata.h"
#include "bakers/preview/pictures/report_plots.h"

namespace skybake {
namespace {

using config::Diagnostic;
using config::Outcome;
namespace fs = std::filesystem;

Outcome<PreviewAsset> load_table(const fs::path& path, const ManifestAsset& entry) {
    Outcome<ExrImage> image = read_exr(path);
    if (!image.value) return {{}, std::move(image.diagnostics)};
    const std::vector<int> size = {image.value->pixels.width, image.value->pixels.height};
    if (size != entry.size || image.value->channel_names != entry.channels) {
        return {{},
                {file_error(
                    "E0304", path.string(),
                    fmt::format("`{}` is not of the size that its manifest says", path.string()))}};
    }
    return {PreviewAsset{entry, std::move(image.value->pixels), {}}, {}};
}

// `file` holds level 0 of `entry`.
Outcome<PreviewAsset> load_volume(const fs::path& path, const ManifestAsset& entry,
                                  ManifestFile file) {
    file.level = 0;
    PreviewAsset asset{entry, {}, {}};
    std::size_t values = entry.channels.size();
    for (const int extent : entry.levels[0].size) values *= static_cast<std::size_t>(extent);
    asset.voxels.resize(values);
    const std::size_t channels = entry.channels.size();
    const auto keep = [&](std::int64_t first, std::int64_t count, const float* voxels) {
        std::copy_n(voxels, static_cast<std::size_t>(count) * channels,
                    asset.voxels.begin() +
                        static_cast<std::ptrdiff_t>(static_cast<std::size_t>(first) * channels));
        return true;
    };
    const Outcome<bool> read = read_volume(path, entry, file, keep);
    if (!read.value) return {{}, read.diagnostics};
    return {std::move(asset), {}};
}

// The file of a level that is read quickest: VDB needs a module and a walk over its tree.
const ManifestFile* file_of_level(const ManifestAsset& entry, std::size_t level) {
    const ManifestFile* found = nullptr;
    for (const ManifestFile& file : entry.files) {
        const bool has_voxels = volume_format_of(file.format).has_value();
        if (file.level != static_cast<int>(level) || !has_voxels) continue;
        if (found == nullptr || found->format == "vdb") found = &file;
    }
    return found;
}

Diagnostic no_file(const ManifestAsset& entry, const fs::path& folder) {
    return file_error("E0304", (folder / manifest_name).string(),
                      fmt::format("the manifest names no file of `{}`", entry.name));
}

// W0304 where the file is not that of which the manifest speaks, or speaks for itself.
std::optional<Diagnostic> other_bytes(const fs::path& path, const ManifestFile& file) {
    const Outcome<FileFingerprint> found = fingerprint(path);
    if (file.xxh3.empty() || !found.value || found.value->xxh3 == file.xxh3) return std::nullopt;
    Diagnostic warning = file_error(
        "W0304", path.string(),
        fmt::format("`{}` does not match {}: the figures there are those of another file",
                    path.string(), manifest_name));
    warning.severity = config::Severity::warning;
    return warning;
}

// What of diagnostics makes it impossible to go on.
bool has_error(const std::vector<Diagnostic>& diagnostics) {
    return std::any_of(diagnostics.begin(), diagnostics.end(), [](const Diagnostic& one) {
        return one.severity == config::Severity::error;
    });
}

// Adds one asset of a manifest to what is shown; what went wrong, if anything did. Warnings become
// notes, too.
std::vector<Diagnostic> add_asset(const fs::path& folder, const ManifestAsset& entry,
                                  PreviewAssets& shown) {
    std::size_t level = 0;
    if (entry.is_volume()) {
        const std::optional<std::size_t> fitting = previewed_level(entry);
        if (fitting != std::size_t{0}) shown.notes.push_back(level_note(entry, fitting));
        if (!fitting) {
            shown.assets.push_back({entry, {}, {}});
            return {};
        }
        level = *fitting;
    }
    const ManifestFile* file = file_of_level(entry, level);
    if (file == nullptr) return {no_file(entry, folder)};
    auto asset = entry.is_volume() ? load_volume(folder / file->path, at_level(entry, level), *file)
                                   : load_table(folder / file->path, entry);
    if (!asset.value) return std::move(asset.diagnostics);
    shown.assets.push_back(std::move(*asset.value));
    const std::optional<Diagnostic> warning = other_bytes(folder / file->path, *file);
    if (!warning) return {};
    shown.notes.push_back(warning->message);
    return {*warning};
}

// Previews of a folder whose recipe this release cannot read still have pictures.
void add_recipe(const Manifest& manifest, const ManifestPlace& place, PreviewAssets& shown) {
    auto recipe = recorded_recipe(manifest, place.file.string(), place.folder);
    if (recipe.value) {
        shown.recipe = std::move(*recipe.value);
        return;
    }
    shown.notes.push_back("there is no sky and no lit cloud: " +
                          recipe.diagnostics.front().message);
}

// The parameters that a cloud's file carries are a recipe of it; those of a table lack what others
// depend on, and may be none. A file may have another name than its section.
void add_own_recipe(PreviewAssets& shown) {
    const ManifestAsset& entry = shown.assets.front().entry;
    auto recipe = config::parse_recipe(entry.parameters, "the file");
    if (!recipe.value) return;
    for (config::Bake& bake : recipe.value->parameters.bakes) {
        if (baker_of(bake).asset == entry.kind) bake.name = entry.name;
    }
    shown.recipe = std::move(*recipe.value);
}

std::string folder_title(const fs::path& folder) {
    const fs::path path = fs::absolute(folder).lexically_normal();
    return path.has_filename() ? path.filename().string() : path.parent_path().filename().string();
}

// The asset of a manifest that a file belongs to, reduced to that file.
std::optional<ManifestAsset> claimed_entry(const Manifest& manifest, const fs::path& name) {
    for (const ManifestAsset& asset : manifest.assets) {
        for (const ManifestFile& file : asset.files) {
            if (fs::path(file.path).lexically_normal() != name) continue;
            ManifestAsset entry =
                asset.is_volume() ? at_level(asset, static_cast<std::size_t>(file.level)) : asset;
            entry.files = {file};
            entry.files[0].level = 0;
            return entry;
        }
    }
    return std::nullopt;
}

// Adds one file by what it says of itself.
std::vector<Diagnostic> add_unclaimed(const fs::path& path, PreviewAssets& shown) {
    const Outcome<ManifestAsset> entry = entry_from_metadata(path);
    if (!entry.value) return entry.diagnostics;
    return add_asset(path.parent_path(), *entry.value, shown);
}

}  // namespace

Outcome<PreviewAssets> load_folder(const fs::path& path) {
    const ManifestPlace place = manifest_place(path);
    const Outcome<Manifest> manifest = read_manifest_file(place.file);
    if (!manifest.value) return {{}, manifest.diagnostics};
    if (manifest.value->assets.empty()) {
        return {{},
                {file_error("E0304", place.file.string(),
                            fmt::format("`{}` names no asset", place.file.string()))}};
    }
    PreviewAssets shown;
    shown.title = folder_title(place.folder);
    add_recipe(*manifest.value, place, shown);
    std::vector<Diagnostic> warnings;
    for (const ManifestAsset& entry : manifest.value->assets) {
        auto problems = add_asset(place.folder, entry, shown);
        if (has_error(problems)) return {{}, std::move(problems)};
        warnings.insert(warnings.end(), problems.begin(), problems.end());
    }
    find_plots(place.folder, shown);
    return {std::move(shown), std::move(warnings)};
}

Outcome<PreviewAssets> load_files(std::span<const fs::path> files) {
    PreviewAssets shown;
    std::vector<Diagnostic> warnings;
    std::optional<Manifest> recorded;  // of the folder that all files are in
    for (const fs::path& path : files) {
        shown.title += (shown.title.empty() ? "" : ", ") + path.filename().string();
        const fs::path folder = path.parent_path();
        Outcome<Manifest> manifest = read_manifest(folder);
        const std::optional<ManifestAsset> entry =
            manifest.value ? claimed_entry(*manifest.value, path.filename()) : std::nullopt;
        auto problems = entry ? add_asset(folder, *entry, shown) : add_unclaimed(path, shown);
        if (has_error(problems)) return {{}, std::move(problems)};
        warnings.insert(warnings.end(), problems.begin(), problems.end());
        if (entry && folder == files.front().parent_path()) recorded = std::move(manifest.value);
    }
    if (!recorded && files.size() == 1) add_own_recipe(shown);
    if (recorded) add_recipe(*recorded, manifest_place(files.front().parent_path()), shown);
    return {std::move(shown), std::move(warnings)};
}

}  // namespace skybake
