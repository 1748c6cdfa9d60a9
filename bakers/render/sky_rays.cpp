#include "bakers/render/sky_rays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "bakers/math/relative_error.h"
#include "bakers/math/transcendental.h"

namespace skybake {
namespace {

// How many pixels beyond a dome's edge still look along the horizontal. A bilinear lookup within
// the circle needs pixels up to a diagonal farther out.
constexpr double kRim = 1.5;

// The sine and the cosine of an elevation in [-90, 90] degrees.
double sine_of_elevation(double degrees) { return cosine_of_pi(0.5 - degrees / 180); }
double cosine_of_elevation(double degrees) { return cosine_of_pi(std::fabs(degrees) / 180); }

// A pixel of a dome in units of its radius, with the sun upwards.
struct DomePoint {
    double across;
    double up;
    double radius;
};

double dome_radius_pixels(const SkyView& view) { return 0.5 * std::min(view.width, view.height); }

DomePoint dome_point(const SkyView& view, double x, double y) {
    const double across = (x - 0.5 * view.width) / dome_radius_pixels(view);
    const double up = (0.5 * view.height - y) / dome_radius_pixels(view);
    return {across, up, std::sqrt(across * across + up * up)};
}

std::array<double, 4> largest_values(const Image2<float>& image) {
    std::array<double, 4> largest{};
    const auto channels = static_cast<std::size_t>(image.channels);
    for (std::size_t i = 0; i < image.texels.size(); ++i) {
        double& value = largest[i % channels];
        value = std::max(value, double{image.texels[i]});
    }
    return largest;
}

}  // namespace

double sun_sine(const SkyView& view) { return sine_of_elevation(view.sun_elevation_degrees); }

double sun_cosine(const SkyView& view) { return cosine_of_elevation(view.sun_elevation_degrees); }

SkyDirection sky_direction(const SkyView& view, double mu, double sine, double azimuth_cosine) {
    return sky_direction(SunZenith{sun_sine(view), sun_cosine(view)}, mu, sine, azimuth_cosine);
}

std::optional<SkyDirection> direction_at(const SkyView& view, int x, int y) {
    return direction_through(view, x + 0.5, y + 0.5);
}

std::optional<SkyDirection> direction_through(const SkyView& view, double x, double y) {
    if (view.projection == SkyProjection::panorama) {
        const double azimuth =
            (x / view.width - 0.5) * view.azimuth_span_degrees / 360;  // in turns
        const double degrees =
            view.highest_degrees - y / view.height * (view.highest_degrees - view.lowest_degrees);
        return sky_direction(view, sine_of_elevation(degrees), cosine_of_elevation(degrees),
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
    const double inside =
        (1 - dome_point(view, x + 0.5, y + 0.5).radius) * dome_radius_pixels(view);
    return std::clamp(inside + 0.5, 0.0, 1.0);
}

SkyDifference sky_difference(const Image2<float>& picture, const Image2<float>& reference,
                             const SkyView& view) {
    const std::array<double, 4> largest = largest_values(reference);
    SkyDifference difference;
    difference.relative = Image2<float>(picture.width, picture.height, 1);
    ErrorStatistics statistics;
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            if (coverage_at(view, x, y) < 0.5) continue;
            double sum = 0;
            for (int c = 0; c < picture.channels; ++c) {
                const double error =
                    relative_error(double{picture.texel(x, y)[c]}, double{reference.texel(x, y)[c]},
                                   largest[static_cast<std::size_t>(c)]);
                statistics.add(error);
                sum += error;
            }
            *difference.relative.texel(x, y) = static_cast<float>(sum / picture.channels);
        }
    }
    difference.error = statistics.figures();
    return difference;
}

}  // namespace skybake
