// Which way each pixel of a picture of the sky looks.
#pragma once

#include <optional>

#include "bakers/field/certify.h"
#include "bakers/field/image.h"
#include "bakers/light/sky_ray.h"

namespace skybake {

// dome      angular (equidistant) fisheye of the upper hemisphere: the zenith in the middle, the
//           horizontal on the largest circle that fits, the sun's azimuth upwards
// panorama  azimuth from -180 degrees at the left over the sun's, in the middle, to 180; elevation
//           evenly from highest to lowest
//
// Both are mirror images about the sun's azimuth: column x is column width - 1 - x.
enum class SkyProjection { dome, panorama };

struct SkyView {
    SkyProjection projection = SkyProjection::dome;
    int width = 0;
    int height = 0;
    double camera_altitude_km = 0;     // in [0, thickness]
    double sun_elevation_degrees = 0;  // above the camera's horizontal, in [-90, 90]
    double lowest_degrees = -10;       // elevations of a panorama
    double highest_degrees = 90;
};

// Of the sun, both exact at the horizon and at the zenith.
double sun_sine(const SkyView& view);  // of its elevation: the cosine of its zenith angle
double sun_cosine(const SkyView& view);

// From the cosine and sine of the zenith angle and the cosine of the azimuth from the sun.
SkyDirection sky_direction(const SkyView& view, double mu, double sine, double azimuth_cosine);

// Of the middle of pixel (x, y). None outside of a dome, but for a rim of one and a half pixels
// that looks along the horizontal, so that the picture may be enlarged and its edge smoothed.
std::optional<SkyDirection> direction_at(const SkyView& view, int x, int y);

// How much of a pixel lies in the picture's circle: 1 inside, 0 outside, between on its edge.
double coverage_at(const SkyView& view, int x, int y);

// How far one picture of the sky is from another.
struct SkyDifference {
    // One channel: of each pixel that of the channel that is furthest off, signed, as a share of
    // max(reference, 1e-3 of the channel's largest); row 0 at the top, 0 outside of a dome.
    Image2<float> relative;
    ErrorFigures error;  // over all channels of the pixels whose middles the picture shows
};

// Of pictures of one view.
SkyDifference sky_difference(const Image2<float>& picture, const Image2<float>& reference,
                             const SkyView& view);

}  // namespace skybake
