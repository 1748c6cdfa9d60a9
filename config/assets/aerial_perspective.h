// asset = "aerial_perspective". The air between a camera and what it looks at.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "config/assets/asset.h"
#include "config/sections/files.h"
#include "config/sections/scene.h"
#include "config/text/quantity.h"

namespace skybake::config {

enum class AerialContent { in_scatter_and_transmittance, in_scatter, transmittance };
enum class SliceSpacing { linear, squared };

// Light scattered into view rays of a camera, up to distances along them.
struct AerialPerspectiveBake : AssetFiles {
    std::array<int, 3> size{};  // voxels across, down and along distance
    AerialContent content = AerialContent::in_scatter_and_transmittance;
    Length altitude;  // of the camera, within the atmosphere
    Angle sun_elevation;
    Angle heading;  // of the view from the sun, to the right
    Angle pitch;    // above the horizontal
    Angle fov;      // vertical
    double aspect = 1;
    Length view_distance;  // where the last slice ends
    SliceSpacing slices = SliceSpacing::squared;
    SkyOrders orders = SkyOrders::all;
    std::vector<std::string> layers;  // single
};

const AssetKind& asset_kind(Tag<AerialPerspectiveBake>);

}  // namespace skybake::config
