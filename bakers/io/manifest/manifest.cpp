#include "bakers/io/manifest/manifest.h"

#include <fmt/format.h>

#include <algorithm>

#include "bakers/io/files/file_io.h"
#include "bakers/io/manifest/claimed_files.h"
#include "bakers/io/manifest/release.h"
#include "bakers/math/hash.h"

namespace skybake {

Manifest new_manifest(const Recipe& recipe) {
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

// Returns a diagnostic if the folder exists but has no manifest.
std::optional<Diagnostic> holds_no_bake(const std::filesystem::path& file) {
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

using Json = nlohmann::ordered_json;

std::string hash_of_text(const Json& json) {
    return xxh3_hex(json.dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace

Outcome<Manifest> read_manifest_file(const std::filesystem::path& file) {
    if (auto diagnostic = holds_no_bake(file)) return std::move(*diagnostic);
    Outcome<std::string> text = read_file(file, largest_manifest);
    if (!text.value) return {{}, std::move(text.diagnostics)};
    return parse_manifest(*text.value, file.string());
}

Outcome<Manifest> read_manifest(const std::filesystem::path& folder) {
    return read_manifest_file(folder / manifest_name);
}

std::optional<Manifest> read_earlier_claims(const std::filesystem::path& folder) {
    const Outcome<std::string> text = read_file(folder / manifest_name, largest_manifest);
    return text.value ? parse_earlier_claims(*text.value) : std::nullopt;
}

ManifestPlace manifest_place(const std::filesystem::path& path) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error)) return {path, path / manifest_name};
    return {path.has_parent_path() ? path.parent_path() : ".", path};
}

Manifest merge_manifests(const Manifest& previous, Manifest fresh) {
    std::vector<ManifestAsset> merged = previous.assets;
    for (ManifestAsset& asset : fresh.assets) {
        const auto known = std::ranges::find(merged, asset.name, &ManifestAsset::name);
        if (known == merged.end()) {
            merged.push_back(std::move(asset));
        } else {
            *known = std::move(asset);
        }
    }
    fresh.assets = std::move(merged);
    return fresh;
}

ClaimedFiles::ClaimedFiles(const Manifest& manifest) : files_{std::string(manifest_name)} {
    for (const ManifestAsset& asset : manifest.assets) {
        for (const ManifestFile& file : asset.files) add(file.path);
    }
    for (const RetiredFile& file : manifest.retired) add(file.path);
}

std::string ClaimedFiles::name_of(const std::filesystem::path& file) {
    return file.lexically_normal().string();
}

std::vector<RetiredFile> files_no_longer_made(const Manifest& previous, const Manifest& fresh) {
    const ClaimedFiles made(fresh);
    std::vector<RetiredFile> retired;
    for (const ManifestAsset& asset : previous.assets) {
        for (const ManifestFile& file : asset.files) {
            if (!made.hold(file.path)) retired.push_back({file.path, file.xxh3});
        }
    }
    for (const RetiredFile& file : previous.retired) {
        if (!made.hold(file.path)) retired.push_back(file);
    }
    return retired;
}

Manifest claims_of(const Manifest& manifest) {
    Manifest claimed;
    claimed.retired = files_no_longer_made(manifest, {});
    return claimed;
}

std::string entry_hash(const Json& entry) {
    Json rest = entry;
    rest.erase("hash");
    return hash_of_text(rest);
}

std::string manifest_hash(const Json& manifest) {
    Json rest = Json::object();
    for (const auto& [key, value] : manifest.items()) {
        if (key == "hash") continue;
        if (key != "assets") {
            rest[key] = value;
            continue;
        }
        rest[key] = Json::array();
        for (const Json& entry : value) rest[key].push_back(entry.at("hash"));
    }
    return hash_of_text(rest);
}

std::vector<std::string> manifest_alterations(const Json& manifest) {
    std::vector<std::string> alterations;
    const Json& entries = manifest.at("assets");
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const std::string found = entry_hash(entries[i]);
        if (found == entries[i].at("hash")) continue;
        alterations.push_back(
            fmt::format("`assets[{}]`, the entry of `{}`, has been changed since the bake wrote "
                        "it: its hash is {}, and `hash` says {}; bake again to get a true entry",
                        i, entries[i].at("name").get<std::string>(), found,
                        entries[i].at("hash").get<std::string>()));
    }
    const std::string found = manifest_hash(manifest);
    if (found != manifest.at("hash")) {
        alterations.push_back(
            fmt::format("the manifest has been changed since the bake wrote it, outside of the "
                        "entries of its assets or in their number: its hash is {}, and `hash` says "
                        "{}; bake again to get a true manifest",
                        found, manifest.at("hash").get<std::string>()));
    }
    return alterations;
}

}  // namespace skybake
