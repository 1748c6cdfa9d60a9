// Pictures of one sky with all clouds of a recipe.
#pragma once

#include <vector>

#include "bakers/preview/pictures/cloud_pictures.h"

namespace skybake {

// Makes one picture for each sun of the layers' volumes together, each at its altitude. Light, camera
// and size are those of the first layer. The copies of each tile vary (TileVariation of
// cloud_medium.h), so that no pattern repeats towards the horizon. Layers whose volume is missing are
// left out. There are no pictures without any layer, or if make_sky_tables (sky_tables.h) refuses the
// tables.
std::vector<PreviewPicture> scene_pictures(const std::vector<CloudPreviewInput>& layers,
                                           int threads);

}  // namespace skybake
