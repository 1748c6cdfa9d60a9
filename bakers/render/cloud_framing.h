// Where the camera of a lit cloud stands, and how finely its picture is marched.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "bakers/render/cloud_view.h"

namespace skybake {

// What the user asks of a camera; what is not asked for is chosen.
struct CameraRequest {
    // x and y from the tile's corner, and the altitude above the ground.
    std::optional<std::array<double, 3>> position_m;
    std::optional<double> heading_degrees;  // from +x towards +y
    std::optional<double> pitch_degrees;    // above the horizontal
    std::optional<double> field_degrees;    // across the picture
};

// Steps of one voxel (the cube root of its volume), longer ones towards a low sun so that there are
// at most kSunSamples. Of a volume that repeats a camera that sees much of the layer, and a reach
// of some tiles; of one that does not a camera that has all of it in the picture.
CloudViewSettings framed_view(const CloudMedium& medium, const SunDirection& sun, int width,
                              int height, const CameraRequest& request = {});

// "position=1.86km,0.72km,0.3km heading=63deg pitch=12deg fov=50deg", which --camera reads.
std::string camera_text(const CloudCamera& camera);

// Where there is something to see, a twentieth of the greatest value at least, in metres: x and y
// from the tile's corner, altitudes. Of a
// volume without anything the whole tile.
struct CloudBox {
    glm::dvec3 low_m{};
    glm::dvec3 high_m{};
};
CloudBox occupied_box(const CloudMedium& medium);

}  // namespace skybake
