// A camera that has all of a volume in its picture, for scenes that place the volume.
//
// It looks a little upwards, as one stands before a cloud, with the lens that 3-D programs begin with:
// 50 mm before a sensor of 36 by 20.25 mm.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace skybake {

struct Baked;

inline constexpr double camera_focal_length_mm = 50;
inline constexpr double camera_width_mm = 36;
inline constexpr double camera_height_mm = 20.25;

struct VolumeCamera {
    glm::dvec3 position_m;  // x, y and z of the volume's files, with z up
    glm::dmat3 axes;        // columns: to the right, up in the picture, and against the view
    double reach_m;         // beyond all of the volume
};

// Precondition: the volume has an extent in metres. A camera below the ground rises to 2 m.
VolumeCamera volume_camera(const Baked& volume);

}  // namespace skybake
