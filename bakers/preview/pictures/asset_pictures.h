// Which pictures show an asset by itself.
#pragma once

#include <vector>

#include "bakers/plot/picture.h"
#include "bakers/render/preview_asset.h"

namespace skybake {

// By the asset's kind; of a volume that has no row of its own, its slices, and of such a table
// nothing.
std::vector<PreviewPicture> asset_pictures(const PreviewAsset& asset);

}  // namespace skybake
