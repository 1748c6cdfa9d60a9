// What the pictures of a cloud take, gathered from the assets of a preview.
#pragma once

#include "bakers/preview/make_preview.h"
#include "bakers/preview/pictures/cloud_pictures.h"
#include "bakers/preview/preview_assets.h"

namespace skybake {

// Of a cloud volume: with the first occupancy grid of it, and the sky. Of an occupancy grid: by
// itself. `cloud` is null where the recipe is not known or does not say what the asset is of.
CloudPreviewInput cloud_input(const PreviewAssets& assets, const PreviewAsset& asset,
                              const PreviewOptions& options);

}  // namespace skybake
