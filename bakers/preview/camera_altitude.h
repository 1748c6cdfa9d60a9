// Whether the camera that the user has asked for is within the air.
#pragma once

#include <optional>

#include "bakers/preview/make_preview.h"
#include "bakers/preview/preview_assets.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// E0110 where options.altitude_m is above the top of the air of a sky that is to be shown: the
// tables end there. Nothing where there is no sky to show.
std::optional<config::Diagnostic> camera_above_air(const PreviewAssets& assets,
                                                   const PreviewOptions& options);

}  // namespace skybake
