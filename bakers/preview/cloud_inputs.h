// Gathers what pictures of clouds are made from.
#pragma once

#include <vector>

#include "bakers/preview/bake_assets.h"
#include "bakers/preview/make_preview.h"
#include "bakers/preview/pictures/cloud_pictures.h"

namespace skybake {

// Gathers the input for the pictures of a cloud from the assets of a preview. For a cloud volume,
// it includes the volume's first occupancy grid and the sky; for an occupancy grid, it is the grid
// alone. `cloud` is null if the recipe is not known or does not say which cloud the asset shows.
CloudPreviewInput cloud_input(const PreviewAssets& assets, const PreviewAsset& asset,
                              const PreviewOptions& options);

// Gathers the layers of the pictures of one sky: of each cloud, the volume with the most voxels.
std::vector<CloudPreviewInput> scene_input(const PreviewAssets& assets,
                                           const PreviewOptions& options);

}  // namespace skybake
