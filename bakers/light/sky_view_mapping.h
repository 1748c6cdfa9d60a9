// The coordinates of the sky-view table: u from the view's azimuth, v from its angle to the
// horizon, with most texels next to the horizon (Hillaire 2020, section 5.3).
//
//   u   azimuth from the sun / 180 degrees; the sky is the same on both sides of the sun
//   v   1/2 + 1/2 sign(l) sqrt(|l| / range),   l the angle above the horizon, downwards negative
//
// The range belongs to the half. Below it extends from the horizon to straight down; above it
// extends to the zenith for cameras in the air, and to the edge of the air for cameras at its top
// and in space, whose rays above that edge see nothing. The horizon is the planet's edge: at
// altitude h it lies arccos(R / (R + h)) below the horizontal.
//
// End points are texel centres, u = 1/2N + x (1 - 1/N). The horizon itself, y = 1/2, belongs to the
// sky. It lies between rows N/2 - 1 and N/2, or on row (N - 1) / 2 if N is odd. Lookups of rays of
// the sky go no lower than the first row of the sky, and those of the ground no higher than the
// last row of the ground, so that sky and ground do not mix at the horizon.
#pragma once

#include "bakers/air/ray.h"
#include "bakers/light/sky_ray.h"

namespace skybake {

class RowOfView;

// A camera above a planet.
class SkyViewCamera {
  public:
    SkyViewCamera(const Shell& shell, double altitude_km);

    // Angles in radians.
    double dip() const { return dip_; }  // of the horizon, below the horizontal
    double range_above() const { return range_above_; }
    double range_below() const { return range_below_; }
    bool in_space() const { return altitude_km_ >= shell_.thickness_km; }

    // Returns the angle above the horizon at a coordinate y in [0, 1], and its inverse.
    double angle_at(double y) const;
    double coordinate(double angle) const;
    static bool meets_ground(double y) { return y < 0.5; }

    // Returns the nearest coordinate whose view is at least kHorizonMargin away from the horizon
    // and, from space, also from the edge of the air.
    double off_the_edges(double y) const;

    // Returns the view ray at a coordinate y and an azimuth from the sun with this cosine.
    SkyRay ray(double y, const SunZenith& sun, double azimuth_cosine) const;

  private:
    friend class RowOfView;
    Shell shell_;
    double altitude_km_;
    double dip_ = 0;
    double dip_to_top_ = 0;  // from space: of the edge of the air, below the horizontal
    double range_above_ = 0;
    double range_below_ = 0;
};

// These are the view rays at one coordinate y, for many azimuths; what they share is computed once.
class RowOfView {
  public:
    RowOfView(const SkyViewCamera& camera, double y, const SunZenith& sun);

    // Returns SkyViewCamera::ray.
    SkyRay ray(double azimuth_cosine) const;

  private:
    SunZenith sun_;
    double mu_ = 0;           // of the view at the camera
    double sine_ = 0;         // of its zenith angle
    double distance_km_ = 0;  // from the camera to where it enters the air
    SkyRay ray_;              // of any azimuth, with the sun as the camera sees it
};

// Returns the v at which a lookup of y is made in a table of `rows` rows (see above).
double sky_view_v(double y, int rows);

// Return the cosine and sine of any angle in radians, with the same bits on every machine.
double cosine_of(double angle);
double sine_of(double angle);

// Returns the sun at an elevation in radians, exact at the horizon and at +-90 degrees.
SunZenith sun_at_elevation(double elevation);

}  // namespace skybake
