// The data that a live page renders: the baked tables and volumes as textures, the numbers of the recipe as
// GLSL, and where the camera and the sun stand at first.
//
// Tables are embedded as floats, which the page stores as halves where a browser cannot filter
// floats. The volume is embedded as unorm8 where that is what was baked or where halves would take
// more than kMostHalfBytes (live_textures.h), else as halves; the scene states the greatest error
// that this makes. All texels are compressed (zlib).
#pragma once

#include <string>
#include <vector>

#include "bakers/march/cloud_medium.h"
#include "bakers/preview/bake_assets.h"
#include "bakers/preview/live/live_textures.h"
#include "bakers/preview/make_preview.h"
#include "bakers/render/cloud_framing.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// A cloud with all that a march through it needs.
struct LiveCloud {
    const PreviewAsset* volume = nullptr;
    CloudMedium medium;
    std::string leaps_name;
    SunDirection sun;
    CameraRequest camera;
};

// Returns the scene as JSON. Where an atmosphere lacks a table that the page needs, the table is
// baked; clouds without an atmosphere are lit by the preset `earth`. All clouds are shown in one sky. A
// cloud whose baked grid does not serve a march gets leaps from its voxels. E0001 if there is no
// recipe to read numbers from, or the air has other than three or four channels.
Outcome<std::string> live_scene(const PreviewAssets& assets, const PreviewOptions& options);

}  // namespace skybake
