#include "bakers/assets/aerial_perspective/aerial_perspective_mapping.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "bakers/light/sky_view_mapping.h"

namespace skybake {

double picture_reach(const config::AerialPerspectiveBake& bake) {
    return sine_of(bake.fov.radians / 2) / cosine_of(bake.fov.radians / 2);
}

AerialCamera::AerialCamera(const config::AerialPerspectiveBake& bake, const Shell& shell)
    : sun_(sun_at_elevation(bake.sun_elevation.radians)),
      altitude_km_(bake.altitude.kilometers()),
      radius_km_(shell.ground_radius_km + altitude_km_),
      view_distance_km_(bake.view_distance.kilometers()),
      slices_(bake.slices) {
    if (bake.slices_begin == config::SlicesBegin::air && altitude_km_ > shell.thickness_km) {
        air_ = shell;
    }
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

SlicedWay AerialCamera::way(double u, double v) const {
    if (!air_) return {0, view_distance_km_};
    const ViewDirection view = direction(u, v);
    const double nearest_km = radius_km_ * view.sine;  // to the planet's centre
    const double ground_km = air_->ground_radius_km;
    const double top_km = ground_km + air_->thickness_km;
    // Half of what the ray cuts out of a sphere.
    const auto half_km = [nearest_km](double radius_km) {
        return std::sqrt(std::max((radius_km - nearest_km) * (radius_km + nearest_km), 0.0));
    };
    // Where a ray misses the air there is no light, whatever its slices are.
    const double way_km = std::max(2 * (half_km(top_km) - half_km(ground_km)), air_->thickness_km);
    return {std::max(-radius_km_ * view.mu - half_km(top_km), 0.0),
            std::min(way_km, view_distance_km_)};
}

double AerialCamera::distance_km(double u, double v, double w) const {
    const SlicedWay along = way(u, v);
    return along.begin_km + along.reach_km * (slices_ == config::SliceSpacing::squared ? w * w : w);
}

}  // namespace skybake
