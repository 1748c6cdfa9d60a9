// asset = "sky_view". The sky as a camera sees it, under given suns.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "config/assets/asset.h"
#include "config/sections/files.h"
#include "config/sections/scene.h"
#include "config/text/quantity.h"

namespace skybake::config {

struct SkyViewBake : AssetFiles {
    std::array<int, 2> size{};  // texels along azimuth, along elevation; of one sun
    Length altitude;            // of the camera, which may be in space
    std::vector<Angle> sun_elevations;
    SkyOrders orders = SkyOrders::all;
    std::vector<std::string> layers;  // single: what scatters; empty: every layer
    SkyMethod sky = SkyMethod::solved;
};

const AssetKind& asset_kind(Tag<SkyViewBake>);

}  // namespace skybake::config
