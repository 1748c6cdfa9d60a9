#include "config/assets/asset_kind.h"

#include <cassert>

#include "config/assets/assets.h"

namespace skybake::config {

std::span<const AssetKind* const> asset_kinds() {
    static const std::vector<const AssetKind*> kinds = [] {
        std::vector<const AssetKind*> all;
        for_each_asset([&all](auto asset) { all.push_back(&asset_kind(asset)); });
        return all;
    }();
    return kinds;
}

const AssetKind& kind_of(const Bake& bake) {
    const AssetKind* kind = nullptr;
    for_each_asset([&]<class Asset>(Tag<Asset> asset) {
        if (bake.is<Asset>()) kind = &asset_kind(asset);
    });
    assert(kind);
    return *kind;
}

const AssetFiles& files_of(const Bake& bake) { return kind_of(bake).files(bake); }

}  // namespace skybake::config
