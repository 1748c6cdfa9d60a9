// How far one picture of the sky is from another.
#pragma once

#include "bakers/field/error_statistics.h"
#include "bakers/field/image.h"
#include "bakers/render/sky_rays.h"

namespace skybake {

struct SkyDifference {
    // One channel: of each pixel that of the channel that is furthest off, signed, as a share of
    // max(reference, 1e-3 of the channel's largest); row 0 at the top, 0 outside of a dome.
    Image2<float> relative;
    ErrorFigures error;  // over all channels of the pixels whose middles the picture shows
};

// Of pictures of one view.
SkyDifference sky_difference(const Image2<float>& picture, const Image2<float>& reference,
                             const SkyView& view);

}  // namespace skybake
