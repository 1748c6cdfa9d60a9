// This header declares the asset "environment": an image of the sky and the ground around a camera,
// which renderers use as an environment map.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "config/assets/asset.h"
#include "config/sections/packets.h"
#include "config/sections/scene.h"
#include "config/text/quantity.h"

namespace skybake::config {

struct EnvironmentBake : LightFiles {
    std::array<int, 2> size{};  // texels around the horizon, and from zenith to nadir
    Length altitude;            // of the camera, which may be in space
    Angle sun_elevation;
    SkyOrders orders = SkyOrders::all;
    std::vector<std::string> layers;  // with orders = single: the layers that scatter; empty: all
};

const AssetKind& asset_kind(Tag<EnvironmentBake>);

}  // namespace skybake::config
