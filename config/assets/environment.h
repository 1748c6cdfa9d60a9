// asset = "environment". The sky and the ground around a camera, as renderers take an environment.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "config/assets/asset.h"
#include "config/sections/files.h"
#include "config/sections/scene.h"
#include "config/text/quantity.h"

namespace skybake::config {

struct EnvironmentBake : AssetFiles {
    std::array<int, 2> size{};  // texels around and from the zenith to straight down
    Length altitude;            // of the camera, which may be in space
    Angle sun_elevation;
    SkyOrders orders = SkyOrders::all;
    std::vector<std::string> layers;  // single: what scatters; empty: every layer
};

const AssetKind& asset_kind(Tag<EnvironmentBake>);

}  // namespace skybake::config
