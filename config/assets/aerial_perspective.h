// This header declares the asset "aerial_perspective": the effect of the air between a camera and
// what it looks at.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "config/sections/files.h"
#include "config/sections/scene.h"
#include "config/text/quantity.h"

namespace skybake::config {

enum class AerialContent { in_scatter_and_transmittance, in_scatter, transmittance };
enum class SliceSpacing { linear, squared };
enum class SlicesBegin { camera, air };

// The voxels hold the light that the air scatters into the view rays of a camera, and the
// transmittance, up to given distances along the rays.
struct AerialPerspectiveBake : LightFiles {
    std::array<int, 3> size{};  // voxels across, down and along distance
    AerialContent content = AerialContent::in_scatter_and_transmittance;
    Length altitude;  // of the camera, within the atmosphere
    Angle sun_elevation;
    Angle heading;  // of the view, measured from the sun to the right
    Angle pitch;    // above the horizontal
    Angle fov;      // vertical
    double aspect = 1;
    Length view_distance;  // where the last slice ends, from where they begin
    SliceSpacing slices = SliceSpacing::squared;
    SlicesBegin slices_begin = SlicesBegin::camera;  // of cameras in the air it is the same
    SkyOrders orders = SkyOrders::all;
    std::vector<std::string> layers;  // with orders = single: the layers that scatter; empty: all
};

}  // namespace skybake::config
