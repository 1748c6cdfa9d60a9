// The clouds of a live page: what is marched, as textures and as numbers.
#pragma once

#include <string>
#include <vector>

#include "bakers/march/cloud_medium.h"
#include "bakers/preview/bake_assets.h"
#include "bakers/preview/live/live_textures.h"
#include "bakers/render/cloud_framing.h"

namespace skybake {

struct PreviewOptions;

// A cloud with all that a march through it needs.
struct LiveCloud {
    const PreviewAsset* volume = nullptr;
    CloudMedium medium;
    std::string leaps_name;
    SunDirection sun;
    CameraRequest camera;
};

// Returns the clouds that a page shows: those of the picture of one sky, whose tiles vary, or the only
// cloud, or the first one if a single tile is wanted.
std::vector<LiveCloud> live_clouds(const PreviewAssets& assets, const PreviewOptions& options);

// Returns the steps and the reach of each cloud and the camera, as the pictures have them: those of one
// sky for several clouds, those of its own picture for one.
FramedScene framed_clouds(const std::vector<LiveCloud>& clouds, int width, int height);

// Describes the clouds for the page's own part of the march, and adds their textures.
LiveJson clouds_json(const std::vector<LiveCloud>& clouds, const FramedScene& scene,
                     LiveJson& textures);

}  // namespace skybake
