// From assets to the page that shows them.
#pragma once

#include <optional>
#include <vector>

#include "bakers/core/progress.h"
#include "bakers/preview/encode_pictures.h"
#include "bakers/preview/page.h"
#include "bakers/preview/preview_assets.h"
#include "config/diagnostic.h"

namespace skybake {

struct PreviewOptions {
    std::vector<double> sun_elevations_deg;  // of skies and lit clouds; empty: a few telling ones
    std::optional<double> exposure_stops;    // 0: an exposure of 1; none: chosen for each picture
    std::optional<double> altitude_m;        // of the camera that looks at the sky
    bool draft = false;                      // few pictures, small and quick
    int threads = 0;                         // 0: as many as the machine has
    Progress* progress = nullptr;
    PictureMemory* memory = nullptr;  // of previews with the same options
};

// All pictures of the assets. Clouds without an atmosphere of their own are lit by the sky of
// preset "earth". Diagnostics of camera_above_air (camera_altitude.h) and png_bytes. No value and
// no diagnostics: the user has interrupted.
config::Outcome<PreviewPage> make_preview(const PreviewAssets& assets,
                                          const PreviewOptions& options);

}  // namespace skybake
