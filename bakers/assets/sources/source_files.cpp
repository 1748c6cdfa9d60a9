#include "bakers/assets/sources/source_files.h"

#include <algorithm>

#include "bakers/io/formats/format.h"
#include "config/recipe/asset_parameters.h"

namespace skybake {

const ManifestAsset* asset_named(const Manifest& manifest, const std::string& name) {
    const auto found = std::ranges::find(manifest.assets, name, &ManifestAsset::name);
    return found != manifest.assets.end() ? &*found : nullptr;
}

const ManifestFile* first_file(const ManifestAsset& asset) {
    const auto found = std::ranges::find_if(asset.files, [](const ManifestFile& file) {
        const Format* format = find_format(file.format);
        return file.level == 0 && format != nullptr && format->read != nullptr;
    });
    return found != asset.files.end() ? &*found : nullptr;
}

std::optional<std::size_t> channel_in(const ManifestAsset& volume, const std::string& name) {
    if (name.empty()) return 0;
    const auto found = std::ranges::find(volume.channels, name);
    if (found == volume.channels.end()) return std::nullopt;
    return static_cast<std::size_t>(found - volume.channels.begin());
}

std::optional<Recipe> recorded_recipe(const ManifestAsset& asset) {
    return config::parse_asset_parameters(asset.parameters, asset.name).value;
}

}  // namespace skybake
