// Pictures of phase functions and of their inverse cumulative distributions.
#pragma once

#include <vector>

#include "bakers/plot/picture.h"
#include "bakers/render/preview_asset.h"

namespace skybake {

// Curves of the texels as the file holds them, a line a channel: over the scattering angle, and
// over the angle's logarithm for the forward peak; of an inverse distribution, the angle over the
// share.
std::vector<PreviewPicture> phase_pictures(const PreviewAsset& asset);

}  // namespace skybake
