#include "bakers/preview/load_assets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <utility>

#include "bakers/assets/registry/registry.h"
#include "bakers/io/files/file_io.h"
#include "bakers/io/formats/format.h"
#include "bakers/io/manifest/asset_files.h"
#include "bakers/io/manifest/metadata.h"
#include "bakers/report/report_files.h"
#include "config/recipe/asset_parameters.h"

namespace skybake {

// --- Files ---------------------------------------------------------------------------------------

namespace {

namespace fs = std::filesystem;

// Loads a level of `entry` that the file holds, as it is shown.
Outcome<PreviewAsset> load_texels(const fs::path& path, const ManifestAsset& entry,
                                  const ManifestFile& file, const ShownLevel& shown) {
    const std::array<int, 3>& size = entry.levels[shown.level].size;
    const std::size_t channels = entry.channels.size();
    ShownTexels texels(size, channels, shown.edge);
    const auto keep = [&](std::int64_t first, std::int64_t count, const float* found) {
        texels.add(first, count, found);
        return true;
    };
    const auto level = static_cast<int>(shown.level);
    const Outcome<bool> read = read_asset_file(path, entry, file, level - file.level, keep);
    if (!read.value) return {{}, read.diagnostics};
    PreviewAsset asset{at_level(entry, shown), {}, {}};
    if (entry.is_volume()) {
        asset.voxels = std::move(texels.values);
    } else {
        const std::array<int, 3>& image = asset.entry.levels[0].size;
        asset.table = Image2<float>(image[0], image[1], static_cast<int>(channels));
        asset.table.texels = std::move(texels.values);
    }
    return {std::move(asset), {}};
}

// Returns the file of a level that is fastest to read. VDB is slow: it needs a module and a walk
// over its tree.
const ManifestFile* file_of_level(const ManifestAsset& entry, int level) {
    const ManifestFile* found = nullptr;
    for (const ManifestFile& file : entry.files) {
        const bool is_held = file.level <= level && level < file.level + file.levels;
        const Format* format = find_format(file.format);
        if (!is_held || format == nullptr || format->read == nullptr) continue;
        if (found == nullptr || found->format == "vdb") found = &file;
    }
    return found;
}

Diagnostic no_file(const ManifestAsset& entry, const fs::path& folder) {
    return file_error("E0304", (folder / manifest_name).string(),
                      fmt::format("the manifest names no file of `{}`", entry.name));
}

// Returns W0304 if the file is not the one that its manifest describes.
std::optional<Diagnostic> other_bytes(const fs::path& path, const ManifestFile& file) {
    const Outcome<FileFingerprint> found = fingerprint(path);
    if (file.xxh3.empty() || !found.value || found.value->xxh3 == file.xxh3) return std::nullopt;
    return file_error(
        "W0304", path.string(),
        fmt::format("`{}` does not match {}: the figures there are those of another file",
                    path.string(), manifest_name));
}

// Whether an error is among the diagnostics, so that loading cannot go on.
bool has_error(const std::vector<Diagnostic>& diagnostics) {
    return std::ranges::any_of(
        diagnostics, [](const Diagnostic& one) { return one.severity == Severity::error; });
}

// Adds one asset of a manifest to the shown ones and returns diagnostics. Warnings also become
// notes.
std::vector<Diagnostic> add_asset(const fs::path& folder, const ManifestAsset& entry,
                                  PreviewAssets& shown) {
    const ShownLevel level = shown_level(entry);
    if (!level.is_whole()) shown.notes.push_back(level_note(entry, level));
    const ManifestFile* file = file_of_level(entry, static_cast<int>(level.level));
    if (file == nullptr) return {no_file(entry, folder)};
    auto asset = load_texels(folder / file->path, entry, *file, level);
    if (!asset.value) return std::move(asset.diagnostics);
    shown.assets.push_back(std::move(*asset.value));
    const std::optional<Diagnostic> warning = other_bytes(folder / file->path, *file);
    if (!warning) return {};
    shown.notes.push_back(warning->message);
    return {*warning};
}

// Adds the recipe. A preview still has pictures if this release cannot read the folder's recipe.
void add_recipe(const Manifest& manifest, const ManifestPlace& place, PreviewAssets& shown) {
    auto recipe = recorded_recipe(manifest, place.file.string(), place.folder);
    if (recipe.value) {
        shown.recipe = std::move(*recipe.value);
        return;
    }
    shown.notes.push_back("there is no sky and no lit cloud: " +
                          recipe.diagnostics.front().message);
}

// Adds the recipe that a single file carries. The parameters in a cloud's file are a complete
// recipe; those in a table's file lack values of other assets and may not be a recipe. A file may
// have another name than its section.
void add_own_recipe(PreviewAssets& shown) {
    const ManifestAsset& entry = shown.assets.front().entry;
    auto recipe = config::parse_asset_parameters(entry.parameters, "the file");
    if (!recipe.value) return;
    for (Bake& bake : recipe.value->parameters.bakes) {
        if (baker_of(bake).asset == entry.kind) bake.name = entry.name;
    }
    shown.recipe = std::move(*recipe.value);
}

std::string folder_title(const fs::path& folder) {
    const fs::path path = fs::absolute(folder).lexically_normal();
    return path.has_filename() ? path.filename().string() : path.parent_path().filename().string();
}

// Returns an asset reduced to what one of its files holds.
ManifestAsset alone(const ManifestAsset& asset, const ManifestFile& file) {
    ManifestAsset entry = at_level(asset, {static_cast<std::size_t>(file.level)});
    entry.files = {file};
    entry.files[0].level = 0;
    return entry;
}

// Returns the asset of a manifest that a file belongs to, reduced to that file.
std::optional<ManifestAsset> claimed_entry(const Manifest& manifest, const fs::path& name) {
    for (const ManifestAsset& asset : manifest.assets) {
        for (const ManifestFile& file : asset.files) {
            if (fs::path(file.path).lexically_normal() != name) continue;
            return alone(asset, file);
        }
    }
    return std::nullopt;
}

// Adds one file, described by its own metadata.
std::vector<Diagnostic> add_unclaimed(const fs::path& path, PreviewAssets& shown) {
    const Outcome<ManifestAsset> entry = entry_of_file(path);
    if (!entry.value) return entry.diagnostics;
    ManifestFile file = entry.value->files[0];
    file.path = path.filename().string();
    return add_asset(path.parent_path(), alone(*entry.value, file), shown);
}

// Adds the plots of speed against error that an earlier `report` left in the folder, or in its
// subfolder `report`. Files with these names that `report` has not drawn are ignored.
void find_plots(const fs::path& folder, PreviewAssets& assets) {
    constexpr std::uintmax_t largest_plot = std::uintmax_t{4} << 20;
    for (const PreviewAsset& asset : assets.assets) {
        const std::string name = asset.entry.name + ".svg";
        for (const fs::path& place : {folder / name, folder / "report" / name}) {
            const Outcome<std::string> text = read_file(place, largest_plot);
            if (!text.value || !is_report_text(name, *text.value)) continue;
            assets.plots[asset.entry.name] = *text.value;
            break;
        }
    }
}

}  // namespace

Outcome<PreviewAssets> load_folder(const fs::path& path, LoadedTexels texels) {
    const ManifestPlace place = manifest_place(path);
    const Outcome<Manifest> manifest = read_manifest_file(place.file);
    if (!manifest.value) return {{}, manifest.diagnostics};
    if (manifest.value->assets.empty()) {
        return file_error("E0304", place.file.string(),
                          fmt::format("`{}` names no asset", place.file.string()));
    }
    PreviewAssets shown;
    shown.title = folder_title(place.folder);
    add_recipe(*manifest.value, place, shown);
    std::vector<Diagnostic> warnings;
    for (const ManifestAsset& entry : manifest.value->assets) {
        if (texels == LoadedTexels::tables && entry.is_volume()) {
            shown.assets.push_back({entry, {}, {}});
            continue;
        }
        auto problems = add_asset(place.folder, entry, shown);
        if (has_error(problems)) return {{}, std::move(problems)};
        warnings.insert(warnings.end(), problems.begin(), problems.end());
    }
    find_plots(place.folder, shown);
    return {std::move(shown), std::move(warnings)};
}

bool add_ready(const ReadyAsset& ready, const std::string& name, PreviewAssets& shown) {
    ManifestAsset entry = ready.entry;
    entry.name = name;
    PreviewAssets found;
    if (!add_asset(ready.folder, entry, found).empty()) return false;
    shown.assets.push_back(std::move(found.assets.front()));
    std::ranges::move(found.notes, std::back_inserter(shown.notes));
    return true;
}

Outcome<PreviewAssets> load_files(std::span<const fs::path> files) {
    PreviewAssets shown;
    std::vector<Diagnostic> warnings;
    std::optional<Manifest> recorded;  // of the folder of all files
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
