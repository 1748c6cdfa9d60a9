// Chooses the camera of a cloud's lit picture and the steps of the march.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "bakers/render/cloud_view.h"
#include "bakers/render/scene_march.h"

namespace skybake {

// The heading is no simple fraction of a turn, so that tiles do not line up in the picture.
inline constexpr double kHeading = 63;

// The camera settings that the user asks for. Missing settings are chosen.
struct CameraRequest {
    // x and y from the tile's corner, and z as the altitude above the ground.
    std::optional<std::array<double, 3>> position_m;
    std::optional<double> heading_degrees;  // from +x towards +y
    std::optional<double> pitch_degrees;    // above the horizontal
    std::optional<double> field_degrees;    // across the picture
    // Whether the whole tile is framed, not what stands in it, which moves from frame to frame.
    bool whole_tile = false;
};

// Chooses the settings of a view, with picture_steps. If the volume repeats, the camera
// sees much of the layer, whose reach is reach_m_from; if it does not repeat, the camera has the
// whole volume in the picture.
CloudViewSettings framed_view(const CloudMedium& medium, const SunDirection& sun, int width,
                              int height, const CameraRequest& request = {});

// Chooses the layers and the camera of a picture of several media, which repeat, or of one. Each layer has steps
// of its own voxels. The camera is that of the lowest medium.
struct FramedScene {
    std::vector<SceneLayer> layers;  // of the media, in their order
    CloudCamera camera;
};
FramedScene framed_scene(const std::vector<const CloudMedium*>& media, const SunDirection& sun,
                         int width, int height, const CameraRequest& request = {});

// Returns the settings of `count` views from all around the cloud of a medium that does not repeat,
// in equal steps from the request's heading towards greater azimuths. The camera turns about the
// vertical axis through the middle of what is there. It is so far away that all of it is in every
// picture, unless the request has a position, which then turns too.
std::vector<CloudViewSettings> turntable_views(const CloudMedium& medium, const SunDirection& sun,
                                               int width, int height, const CameraRequest& request,
                                               int count);

// Describes the camera in the form that --camera reads: "position=1.86km,0.72km,0.3km heading=63deg
// pitch=12deg fov=50deg".
std::string camera_text(const CloudCamera& camera);

// The box that holds all voxels of at least a twentieth of the greatest value, in metres: x and y
// from the tile's corner, z as altitude. For an empty volume it is the whole tile.
struct CloudBox {
    glm::dvec3 low_m{};
    glm::dvec3 high_m{};
};
CloudBox occupied_box(const CloudMedium& medium);

}  // namespace skybake
