// This header holds what the structs of all assets have in common. The header of each asset
// declares its struct, and a function asset_kind that says how recipes ask for the asset.
#pragma once

namespace skybake::config {

// A tag says which asset is meant: asset_kind(Tag<IrradianceBake>{}).
template <class Asset>
struct Tag {};

struct AssetKind;  // asset_kind.h

}  // namespace skybake::config
