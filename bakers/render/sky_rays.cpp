#include "bakers/render/sky_rays.h"

#include <algorithm>
#include <cmath>

#include "bakers/math/transcendental.h"

namespace skybake {

namespace {

// Pixels beyond a dome's edge that still look along the horizontal: a bilinear lookup within the
// circle reaches a diagonal further.
constexpr double kRim = 1.5;

// Of an elevation in [-90, 90] degrees.
double sine_of(double degrees) { return cosine_of_pi(0.5 - degrees / 180); }
double cosine_of(double degrees) { return cosine_of_pi(std::fabs(degrees) / 180); }

// A pixel of a dome in units of its radius, the sun upwards.
struct DomePoint {
    double across;
    double up;
    double radius;
};

double dome_radius_pixels(const SkyView& view) { return 0.5 * std::min(view.width, view.height); }

DomePoint dome_point(const SkyView& view, int x, int y) {
    const double across = (x + 0.5 - 0.5 * view.width) / dome_radius_pixels(view);
    const double up = (0.5 * view.height - (y + 0.5)) / dome_radius_pixels(view);
    return {across, up, std::sqrt(across * across + up * up)};
}

}  // namespace

double sun_sine(const SkyView& view) { return sine_of(view.sun_elevation_degrees); }

double sun_cosine(const SkyView& view) { return cosine_of(view.sun_elevation_degrees); }

SkyDirection sky_direction(const SkyView& view, double mu, double sine, double azimuth_cosine) {
    return sky_direction(SunZenith{sun_sine(view), sun_cosine(view)}, mu, sine, azimuth_cosine);
}

std::optional<SkyDirection> direction_at(const SkyView& view, int x, int y) {
    if (view.projection == SkyProjection::panorama) {
        const double azimuth = (x + 0.5) / view.width - 0.5;  // in turns
        const double degrees =
            view.highest_degrees -
            (y + 0.5) / view.height * (view.highest_degrees - view.lowest_degrees);
        return sky_direction(view, sine_of(degrees), cosine_of(degrees),
                             cosine_of_pi(2 * std::fabs(azimuth)));
    }
    const DomePoint point = dome_point(view, x, y);
    if (point.radius > 1 + kRim / dome_radius_pixels(view)) return std::nullopt;
    const double half_angle = 0.5 * std::min(point.radius, 1.0);  // of the zenith angle, in pi
    const double azimuth_cosine = point.radius > 0 ? point.up / point.radius : 1;
    return sky_direction(view, cosine_of_pi(half_angle), cosine_of_pi(0.5 - half_angle),
                         azimuth_cosine);
}

double coverage_at(const SkyView& view, int x, int y) {
    if (view.projection == SkyProjection::panorama) return 1;
    const double inside = (1 - dome_point(view, x, y).radius) * dome_radius_pixels(view);
    return std::clamp(inside + 0.5, 0.0, 1.0);
}

}  // namespace skybake
