#include "bakers/preview/preview_assets.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace skybake {

const PreviewAsset* PreviewAssets::of_kind(std::string_view kind) const {
    const auto found = std::find_if(assets.begin(), assets.end(), [&](const PreviewAsset& asset) {
        return asset.entry.kind == kind;
    });
    return found == assets.end() ? nullptr : &*found;
}

std::optional<std::size_t> previewed_level(const ManifestAsset& asset) {
    for (std::size_t level = 0; level < asset.levels.size(); ++level) {
        // Each extent is at most 65536 (see manifest_reader.cpp): the product fits into 64 bits.
        std::size_t values = asset.channels.size();
        for (const int extent : asset.levels[level].size)
            values *= static_cast<std::size_t>(extent);
        if (values <= most_previewed_values) return level;
    }
    return std::nullopt;
}

ManifestAsset at_level(const ManifestAsset& asset, std::size_t level) {
    if (level == 0) return asset;
    ManifestAsset reduced = asset;
    reduced.levels = {asset.levels[level]};
    const std::array<int, 3>& size = reduced.levels[0].size;
    reduced.size.assign(size.begin(), size.begin() + static_cast<long>(asset.axes.size()));
    reduced.content_hash = reduced.levels[0].content_hash;
    return reduced;
}

std::string level_note(const ManifestAsset& asset, std::optional<std::size_t> level) {
    const std::string size = fmt::format("{}", fmt::join(asset.size, " x "));
    if (level) {
        return fmt::format("{}: {} voxels are more than a preview holds; it shows level {}",
                           asset.name, size, *level);
    }
    return fmt::format(
        "{}: {} voxels are more than a preview holds, and no level of its `mips` is small enough",
        asset.name, size);
}

}  // namespace skybake
