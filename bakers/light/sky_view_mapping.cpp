#include "bakers/light/sky_view_mapping.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "bakers/field/image.h"
#include "bakers/math/transcendental.h"

namespace skybake {
namespace {

// arccos(R / (R + h)) = 2 arcsin sqrt(h / (2 (R + h))): no digits are lost near h = 0.
double angle_to_tangent(double radius_km, double altitude_km) {
    return std::numbers::pi -
           2 * arc_cosine(std::sqrt(altitude_km / (2 * (radius_km + altitude_km))));
}

}  // namespace

double cosine_of(double angle) { return cosine_of_turns(angle / (2 * std::numbers::pi)); }

double sine_of(double angle) { return cosine_of_turns(angle / (2 * std::numbers::pi) - 0.25); }

SkyViewCamera::SkyViewCamera(const Shell& shell, double altitude_km)
    : shell_(shell),
      altitude_km_(altitude_km),
      dip_(angle_to_tangent(shell.ground_radius_km, altitude_km)) {
    range_below_ = std::numbers::pi / 2 - dip_;
    range_above_ = std::numbers::pi / 2 + dip_;
    if (in_space()) {
        dip_to_top_ = angle_to_tangent(shell.ground_radius_km + shell.thickness_km,
                                       altitude_km - shell.thickness_km);
        range_above_ = dip_ - dip_to_top_;
    }
}

double SkyViewCamera::angle_at(double y) const {
    const double centred = 2 * y - 1;
    return (centred < 0 ? -range_below_ : range_above_) * (centred * centred);
}

double SkyViewCamera::coordinate(double angle) const {
    if (angle < 0) return 0.5 - 0.5 * std::sqrt(-angle / range_below_);
    return range_above_ > 0 ? 0.5 + 0.5 * std::sqrt(angle / range_above_) : 0.5;
}

double SkyViewCamera::off_the_edges(double y) const {
    const double angle = angle_at(y);
    // From far away even the whole range may be no wider.
    const double below = std::min(kHorizonMargin, 0.25 * range_below_);
    if (meets_ground(y)) return coordinate(std::min(angle, -below));
    const double above = std::min(kHorizonMargin, 0.25 * range_above_);
    const double highest = in_space() ? range_above_ - above : range_above_;
    return coordinate(std::clamp(angle, above, highest));
}

SkyRay SkyViewCamera::ray(double y, const SunZenith& sun, double azimuth_cosine) const {
    return RowOfView(*this, y, sun).ray(azimuth_cosine);
}

RowOfView::RowOfView(const SkyViewCamera& camera, double y, const SunZenith& sun) : sun_(sun) {
    const Shell& shell = camera.shell_;
    const double angle = camera.angle_at(y);
    const double dip = camera.dip_;
    const double r = shell.ground_radius_km + camera.altitude_km_;
    mu_ = std::clamp(sine_of(angle - dip), -1.0, 1.0);
    sine_ = std::clamp(cosine_of(angle - dip), 0.0, 1.0);
    ray_.altitude_km = camera.altitude_km_;
    ray_.s_km = r * mu_;
    ray_.sun_s_km = r * sun.cosine;
    ray_.meets_ground = SkyViewCamera::meets_ground(y);
    if (camera.in_space()) {
        // The ray enters where r^2 = R_top^2, passing the centre at p = r cos(dip - angle); with
        // R_top = r cos(dip_to_top), R_top - p is a product of sines.
        const double p = r * sine_;
        const double top = shell.ground_radius_km + shell.thickness_km;
        const double gap = 2 * r * sine_of(0.5 * (dip - angle + camera.dip_to_top_)) *
                           sine_of(0.5 * (dip - angle - camera.dip_to_top_));
        const double entry_s = -std::sqrt(std::max(gap, 0.0) * (top + p));
        distance_km_ = entry_s - ray_.s_km;
        ray_.altitude_km = shell.thickness_km;
        ray_.s_km = entry_s;
    }
    ray_.length_km = ray_length_km(shell, ray_.altitude_km, ray_.s_km, ray_.meets_ground);
}

SkyRay RowOfView::ray(double azimuth_cosine) const {
    const SkyDirection direction = sky_direction(sun_, mu_, sine_, azimuth_cosine);
    SkyRay ray = ray_;
    ray.cosine_to_sun = direction.cosine_to_sun;
    ray.one_minus_cosine = direction.one_minus_cosine;
    ray.one_plus_cosine = direction.one_plus_cosine;
    ray.sun_s_km += distance_km_ * ray.cosine_to_sun;
    return ray;
}

double sky_view_v(double y, int rows) {
    assert(rows >= 1);
    const double v = texture_coordinate(TexelConvention::end_points_on_texel_centres, y, rows);
    const int first_of_sky = rows / 2;
    if (!SkyViewCamera::meets_ground(y)) return std::max(v, (first_of_sky + 0.5) / rows);
    return first_of_sky > 0 ? std::min(v, (first_of_sky - 0.5) / rows) : v;
}

SunZenith sun_at_elevation(double elevation) {
    return {std::clamp(sine_of(elevation), -1.0, 1.0), std::clamp(cosine_of(elevation), 0.0, 1.0)};
}

}  // namespace skybake
