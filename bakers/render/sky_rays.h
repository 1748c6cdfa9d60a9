// The view direction of each pixel in a picture of the sky, and the difference between two such
// pictures.
#pragma once

#include <optional>

#include "bakers/field/certify.h"
#include "bakers/field/image.h"
#include "bakers/light/sky_ray.h"

namespace skybake {

// dome      angular (equidistant) fisheye of the upper hemisphere: the zenith in the middle, the
//           horizontal on the largest circle that fits, the sun's azimuth upwards
// panorama  azimuth evenly, with the sun's in the middle; elevation evenly from highest to lowest
//
// Both are symmetric about the sun's azimuth: column x equals column width - 1 - x.
enum class SkyProjection { dome, panorama };

struct SkyView {
    SkyProjection projection = SkyProjection::dome;
    int width = 0;
    int height = 0;
    double camera_altitude_km = 0;     // in [0, thickness]
    double sun_elevation_degrees = 0;  // above the camera's horizontal, in [-90, 90]
    double lowest_degrees = -10;       // elevations of a panorama
    double highest_degrees = 90;
    double azimuth_span_degrees = 360;  // of a panorama, from its left edge to its right one
};

// The sine and the cosine of the sun's elevation. Both are exact at the horizon and at the zenith.
double sun_sine(const SkyView& view);  // also the cosine of the zenith angle
double sun_cosine(const SkyView& view);

// Makes a direction from the cosine `mu` and the sine of the zenith angle and the cosine of the
// azimuth relative to the sun.
SkyDirection sky_direction(const SkyView& view, double mu, double sine, double azimuth_cosine);

// Returns the direction at the middle of pixel (x, y), or nothing outside of a dome. A rim of one
// and a half pixels around the dome looks along the horizontal, so that the picture may be enlarged
// and its edge smoothed.
std::optional<SkyDirection> direction_at(const SkyView& view, int x, int y);

// Returns the same for any place, in pixels from the picture's upper left corner.
std::optional<SkyDirection> direction_through(const SkyView& view, double x, double y);

// Returns the share of a pixel that lies in the picture's circle: 1 inside, 0 outside, and values
// between on its edge.
double coverage_at(const SkyView& view, int x, int y);

// The difference between two pictures of the sky.
struct SkyDifference {
    // An image of one channel: for each pixel, the mean over the channels of the signed relative
    // difference, as a share of max(reference, 1e-3 of the channel's largest value). Row 0 is at the
    // top; pixels outside of a dome are 0.
    Image2<float> relative;
    ErrorFigures error;  // over all channels of the pixels whose middles are shown
};

// Compares two pictures of the same view.
SkyDifference sky_difference(const Image2<float>& picture, const Image2<float>& reference,
                             const SkyView& view);

}  // namespace skybake
