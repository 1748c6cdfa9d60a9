#include "bakers/render/cloud_camera.h"

#include <cmath>

namespace skybake {

CameraRays::CameraRays(const CloudCamera& camera, int width, int height)
    : forward_(direction_of(camera.elevation_degrees, camera.azimuth_degrees)),
      right_(direction_of(0, camera.azimuth_degrees - 90)),
      up_(direction_of(camera.elevation_degrees + 90, camera.azimuth_degrees)),
      half_width_(sine_of_degrees(camera.horizontal_field_degrees / 2) /
                  cosine_of_degrees(camera.horizontal_field_degrees / 2)),
      width_(width),
      height_(height) {}

glm::dvec3 CameraRays::through(double x, double y) const {
    const double across = (x + 0.5 - 0.5 * width_) * pixel();
    const double upwards = (0.5 * height_ - y - 0.5) * pixel();
    const glm::dvec3 ray = forward_ + across * right_ + upwards * up_;
    return ray / std::sqrt(glm::dot(ray, ray));
}

}  // namespace skybake
