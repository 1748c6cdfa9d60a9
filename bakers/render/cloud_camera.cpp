#include "bakers/render/cloud_camera.h"

#include <algorithm>
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
    const double pixel = 2 * half_width_ / width_;
    const double across = (x + 0.5 - 0.5 * width_) * pixel;
    const double upwards = (0.5 * height_ - y - 0.5) * pixel;
    const glm::dvec3 ray = forward_ + across * right_ + upwards * up_;
    return ray / std::sqrt(glm::dot(ray, ray));
}

// The pattern is that of Jimenez 2014. Other layers are the same pattern, moved by an irrational
// number of pixels.
float gradient_noise(int x, int y, int layer) {
    const auto fraction = [](double v) { return v - std::floor(v); };
    const double moved = 5.588238 * layer;
    const double slope = 0.06711056 * (x + moved) + 0.00583715 * (y + moved);
    return static_cast<float>(fraction(52.9829189 * fraction(slope)));
}

RaySpan span_in_layer(const CloudMedium& medium, const CloudCamera& camera,
                      const glm::dvec3& direction, double reach_m) {
    RaySpan span{0, reach_m};
    for (std::size_t a = medium.repeats ? 2 : 0; a < 3; ++a) {
        const double low = (a == 2 ? medium.base_m : 0) - camera.position_m[a];
        const double high = low + medium.extent_m[a];
        const double slope = direction[a];
        if (slope == 0) {
            if (low > 0 || high < 0) return {1, 0};
            continue;
        }
        span.first_m = std::max(span.first_m, (slope > 0 ? low : high) / slope);
        span.last_m = std::min(span.last_m, (slope > 0 ? high : low) / slope);
    }
    return span;
}

}  // namespace skybake
