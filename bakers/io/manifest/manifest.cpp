#include "bakers/io/manifest/manifest.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "bakers/io/files/file_diagnostic.h"
#include "bakers/io/files/read_file.h"
#include "bakers/io/manifest/release.h"

namespace skybake {

Manifest new_manifest(const config::Recipe& recipe) {
    Manifest manifest;
    manifest.tool_name = tool_name();
    manifest.tool_version = release();
    manifest.parameters = parameters_json(recipe.values);
    return manifest;
}

std::vector<int> size_of(const ManifestAsset& asset, const ManifestFile& file) {
    const auto& size = asset.levels[static_cast<std::size_t>(file.level)].size;
    return {size.begin(), size.begin() + static_cast<long>(asset.axes.size())};
}

namespace {

constexpr std::uintmax_t largest_manifest = std::uintmax_t{64} << 20;

// A folder without a manifest; none where the manifest is there, or the folder is not.
std::optional<config::Diagnostic> holds_no_bake(const std::filesystem::path& file) {
    const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
    std::error_code error;
    const bool looks_like_none = file.filename() == manifest_name &&
                                 std::filesystem::is_directory(folder, error) &&
                                 !std::filesystem::exists(symlink_status(file, error));
    if (!looks_like_none) return std::nullopt;
    return file_error(
        "E0300", folder.string(),
        fmt::format("`{}` holds no bake: it has no {}", folder.string(), manifest_name));
}

}  // namespace

config::Outcome<Manifest> read_manifest_file(const std::filesystem::path& file) {
    if (auto diagnostic = holds_no_bake(file)) return {{}, {std::move(*diagnostic)}};
    config::Outcome<std::string> text = read_file(file, largest_manifest);
    if (!text.value) return {{}, std::move(text.diagnostics)};
    return parse_manifest(*text.value, file.string());
}

config::Outcome<Manifest> read_manifest(const std::filesystem::path& folder) {
    return read_manifest_file(folder / manifest_name);
}

std::optional<Manifest> read_earlier_claims(const std::filesystem::path& folder) {
    const config::Outcome<std::string> text = read_file(folder / manifest_name, largest_manifest);
    return text.value ? parse_earlier_claims(*text.value) : std::nullopt;
}

ManifestPlace manifest_place(const std::filesystem::path& path) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error)) return {path, path / manifest_name};
    return {path.has_parent_path() ? path.parent_path() : ".", path};
}

Manifest merge_manifests(const Manifest& previous, Manifest fresh) {
    std::vector<ManifestAsset> merged;
    const auto named = [](std::vector<ManifestAsset>& assets, const std::string& name) {
        return std::find_if(assets.begin(), assets.end(),
                            [&name](const ManifestAsset& asset) { return asset.name == name; });
    };
    for (const ManifestAsset& asset : previous.assets) {
        const auto replacement = named(fresh.assets, asset.name);
        if (replacement == fresh.assets.end()) {
            merged.push_back(asset);
        } else {
            merged.push_back(std::move(*replacement));
            fresh.assets.erase(replacement);
        }
    }
    std::move(fresh.assets.begin(), fresh.assets.end(), std::back_inserter(merged));
    fresh.assets = std::move(merged);
    return fresh;
}

bool claims(const Manifest& manifest, const std::filesystem::path& file) {
    const std::filesystem::path wanted = file.lexically_normal();
    if (wanted == manifest_name) return true;
    for (const ManifestAsset& asset : manifest.assets) {
        for (const ManifestFile& claimed : asset.files) {
            if (std::filesystem::path(claimed.path).lexically_normal() == wanted) return true;
        }
    }
    return std::any_of(manifest.retired.begin(), manifest.retired.end(),
                       [&wanted](const RetiredFile& retired) {
                           return std::filesystem::path(retired.path).lexically_normal() == wanted;
                       });
}

std::vector<RetiredFile> files_no_longer_made(const Manifest& previous, const Manifest& fresh) {
    std::vector<RetiredFile> retired;
    for (const ManifestAsset& asset : previous.assets) {
        for (const ManifestFile& file : asset.files) {
            if (!claims(fresh, file.path)) retired.push_back({file.path, file.xxh3});
        }
    }
    for (const RetiredFile& file : previous.retired) {
        if (!claims(fresh, file.path)) retired.push_back(file);
    }
    return retired;
}

Manifest claims_of(const Manifest& manifest) {
    Manifest claimed;
    claimed.retired = files_no_longer_made(manifest, {});
    return claimed;
}

}  // namespace skybake
