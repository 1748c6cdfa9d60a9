// The light of a sky that is not uniform, as it enters a layer along discrete ordinates.
//
// Each ordinate stands for a part of the hemisphere of its own solid angle: a ring between two cosines
// of the zenith angle, of which the rings in their order have widths in proportion to their weights,
// and of the ring the azimuths that are nearest to the ordinate's. An ordinate carries the mean
// radiance of its part. So the fluence of all ordinates is the sky's. Their irradiance of a level
// surface would not be, for the centre of a ring is not its ordinate: a slope along the cosine, which
// leaves the fluence as it is, makes it so. Skies whose light is next to a single ring would need a
// slope at which ordinates are negative, 1 or more: they keep the means.
#pragma once

#include <functional>
#include <vector>

#include "bakers/assets/cloud_light/hemisphere_harmonics.h"
#include "bakers/math/vectors.h"

namespace skybake::cloud_light {

// The radiance of a sky by the direction in which it is seen, a unit vector that rises.
using SkyByDirection = std::function<double(const glm::dvec3& direction)>;

// Returns the mean of the sky's radiance over the upper hemisphere by solid angle.
double mean_radiance(const SkyByDirection& sky);

// Returns the radiance of each ordinate, at least 0 for a sky that is. Ordinates rise, and those of a
// ring share the height of their directions and their solid angle.
std::vector<double> ordinate_radiances(const SkyByDirection& sky,
                                       const std::vector<SkyDirection>& ordinates);

}  // namespace skybake::cloud_light
