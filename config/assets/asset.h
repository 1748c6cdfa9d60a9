// This header holds what the structs of all assets have in common. The header of each asset declares
// its struct, and its source defines how recipes ask for the asset:
//
//   AssetKind asset_kind(Tag<IrradianceBake>) {
//
// An asset of assets.h that has no such function does not link.
#pragma once

namespace skybake::config {

struct AssetKind;  // asset_kind.h

// The friend is a function of its own for each asset, which is what GCC warns of.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wnon-template-friend"
#endif
template <class Asset>
struct Tag {
    friend AssetKind asset_kind(Tag<Asset>);
};
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif

}  // namespace skybake::config
