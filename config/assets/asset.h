// What the structs of all assets have in common: each header of this folder declares one, and a
// function asset_kind that says how recipes ask for it.
#pragma once

namespace skybake::config {

// Says which asset is meant: asset_kind(Tag<IrradianceBake>{}).
template <class Asset>
struct Tag {};

struct AssetKind;  // asset_kind.h

}  // namespace skybake::config
