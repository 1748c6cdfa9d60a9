// Pictures of noise volumes.
#pragma once

#include <vector>

#include "bakers/plot/picture.h"
#include "bakers/render/preview_asset.h"

namespace skybake {

// Three slices through the middle, two by two tiles that would show a seam, histogram and spectrum,
// each with all channels. Nothing of an asset that is no volume, or whose voxels are not as many as
// its size says.
std::vector<PreviewPicture> noise_pictures(const PreviewAsset& asset);

}  // namespace skybake
