#include "bakers/assets/aerial_perspective/aerial_perspective_mapping.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "bakers/light/sky_view_mapping.h"
#include "config/assets/aerial_perspective.h"

namespace skybake {

double picture_reach(const config::AerialPerspectiveBake& bake) {
    return sine_of(bake.fov.radians / 2) / cosine_of(bake.fov.radians / 2);
}

AerialCamera::AerialCamera(const config::AerialPerspectiveBake& bake)
    : sun_(sun_at_elevation(bake.sun_elevation.radians)),
      altitude_km_(bake.altitude.kilometers()),
      view_distance_km_(bake.view_distance.kilometers()),
      slices_(bake.slices) {
    const double level = cosine_of(bake.pitch.radians);
    const double rise = sine_of(bake.pitch.radians);
    const double ahead = cosine_of(bake.heading.radians);
    const double aside = sine_of(bake.heading.radians);
    const double tangent = picture_reach(bake);
    const double across = tangent * bake.aspect;
    forward_ = {level * ahead, level * aside, rise};
    right_ = {-across * aside, across * ahead, 0};
    up_ = {-tangent * rise * ahead, -tangent * rise * aside, tangent * level};
}

ViewDirection AerialCamera::direction(double u, double v) const {
    const glm::dvec3 ray = forward_ + (2 * u - 1) * right_ + (1 - 2 * v) * up_;
    const double length = std::sqrt(glm::dot(ray, ray));
    const double level = std::sqrt(ray.x * ray.x + ray.y * ray.y);
    return {ray.z / length, level / length, level > 0 ? std::clamp(ray.x / level, -1.0, 1.0) : 1};
}

double AerialCamera::distance_km(double w) const {
    return view_distance_km_ * (slices_ == config::SliceSpacing::squared ? w * w : w);
}

}  // namespace skybake
