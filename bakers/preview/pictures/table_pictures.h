// Pictures of transmittance and multiple-scattering tables.
#pragma once

#include <vector>

#include "bakers/plot/picture.h"
#include "bakers/render/preview_asset.h"

namespace skybake {

// What lookups of the table return over zenith angle and altitude, tone-mapped and in false colours
// for each channel; profiles along the ground and along altitude; and the texels as they lie in the
// file. Of a table whose parameters this release cannot read, the texels alone.
std::vector<PreviewPicture> table_pictures(const PreviewAsset& asset);

}  // namespace skybake
