// One small picture that says most of what an asset, or a set of them, looks like.
#pragma once

#include <optional>
#include <string>

#include "bakers/plot/picture.h"
#include "bakers/preview/make_preview.h"
#include "bakers/preview/preview_assets.h"

namespace skybake {

struct TellingPicture {
    Picture picture;
    std::string light;  // exposure, tone curve and sun of a picture of light; else empty
};

// A lit cloud where there is one, else a panorama of the sky, else a slice, else a table. Without
// exposure_stops the exposure is chosen for the picture and written there, so that the next ones
// have the same. None where there is nothing to show.
std::optional<TellingPicture> telling_picture(const PreviewAssets& assets, PreviewOptions& options);

}  // namespace skybake
