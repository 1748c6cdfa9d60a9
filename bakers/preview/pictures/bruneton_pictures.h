// Pictures of Bruneton's tables.
#pragma once

#include <vector>

#include "bakers/plot/picture.h"
#include "bakers/render/preview_asset.h"

namespace skybake {

// The texels in colour, v upwards: of tables of scattering at four altitudes, and of A, where the
// Mie layers are, beside them.
std::vector<PreviewPicture> bruneton_pictures(const PreviewAsset& asset);

}  // namespace skybake
