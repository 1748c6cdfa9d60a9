// The coordinates of the multiple-scattering table: u from the sun's cosine, v from altitude, both
// with end points on texel centres, u = 1/2N + x (1 - 1/N); and the suns that a table must hold for
// a scene.
//
//   hillaire  x = (mu_s + 1) / 2                      the paper's, linear in the cosine
//   twilight  x = (1 + sign(mu_s) sqrt(|mu_s|)) / 2   spends its texels about the terminator
//
// and y = altitude / thickness in both. Column 0 is mu_s = -1, row 0 the ground.
#pragma once

#include <optional>

#include "bakers/air/ray.h"
#include "config/sections/scene.h"

namespace skybake {

// Returns the sun's cosine at a coordinate in [0, 1].
double sun_cos_zenith_at(config::MultipleScatteringMapping mapping, double x);

// Returns the coordinate of a cosine in [-1, 1]. This is the inverse of sun_cos_zenith_at within
// 1e-12.
double sun_coordinate(config::MultipleScatteringMapping mapping, double sun_cos_zenith);

// A range of the cosine of the sun's zenith angle.
struct SunRange {
    double lowest = -1;
    double highest = 1;
};

// Returns the range over all points in the air, its top and the ground included, that view rays
// from the scene's cameras pass under the scene's suns.
//
// Seen from the planet's centre, the point of such a ray that is furthest from the camera is at
// most as far as the point where the ray that grazes the ground leaves the air:
//
//   psi = arccos(R / (R + h)) + arccos(R / R_top)
//
// with h the highest camera's altitude, in the air or in space. The sun's zenith angle at a point
// differs from that at the camera by at most psi. Cameras that look along the sun's azimuth attain
// this bound.
SunRange scene_sun_range(const config::Scene& scene, const Shell& shell);

// The sun's axis of a table of multiple scattering: the mapping restricted to the suns of the
// scene.
struct SunColumns {
    config::MultipleScatteringMapping mapping = config::MultipleScatteringMapping::hillaire;
    double first = 0;  // the mapping's coordinate where the axis begins
    double last = 1;

    double cosine(double x) const { return sun_cos_zenith_at(mapping, first + (last - first) * x); }
    double coordinate(double sun_cos_zenith) const {
        return (sun_coordinate(mapping, sun_cos_zenith) - first) / (last - first);
    }
};

// Returns the axis for the scene, or the whole axis without a scene.
SunColumns sun_columns(config::MultipleScatteringMapping mapping,
                       const std::optional<config::Scene>& scene, const Shell& shell);

}  // namespace skybake
