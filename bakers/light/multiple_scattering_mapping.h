// Where multiple scattering stands in its table: u from the sun's cosine, v from altitude, both
// with end points on texel centres, u = 1/2N + x (1 - 1/N).
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

// The sun's cosine at a coordinate in [0, 1].
double sun_cos_zenith_at(config::MultipleScatteringMapping mapping, double x);

// The coordinate of a cosine in [-1, 1]; the inverse of the above within 1e-12.
double sun_coordinate(config::MultipleScatteringMapping mapping, double sun_cos_zenith);

// Which suns a table must hold for the cameras and suns of a scene.

// Of the cosine of the sun's zenith angle.
struct SunRange {
    double lowest = -1;
    double highest = 1;
};

// Of all points in the air, its top and the ground included, that view rays from the scene's
// cameras pass under the scene's suns.
//
// From the planet's centre no point of such a ray is further from the camera than the one where the
// ray that grazes the ground leaves the air:
//
//   psi = arccos(R / (R + h)) + arccos(R / R_top)
//
// with h the highest camera's altitude, in the air or in space, and the sun's zenith angle at a
// point differs from that at the camera by no more than psi. Attained by cameras that look along
// the sun's azimuth.
SunRange scene_sun_range(const config::Scene& scene, const Shell& shell);

// The sun's axis of a table of multiple scattering: the mapping over the suns of the scene.

struct SunColumns {
    config::MultipleScatteringMapping mapping = config::MultipleScatteringMapping::hillaire;
    double first = 0;  // of the mapping's coordinate
    double last = 1;

    double cosine(double x) const { return sun_cos_zenith_at(mapping, first + (last - first) * x); }
    double coordinate(double sun_cos_zenith) const {
        return (sun_coordinate(mapping, sun_cos_zenith) - first) / (last - first);
    }
};

// The whole axis without a scene.
SunColumns sun_columns(config::MultipleScatteringMapping mapping,
                       const std::optional<config::Scene>& scene, const Shell& shell);

}  // namespace skybake
