// The definition of light_in_cloud.h at one place, slowly and in double: harmonics of coefficients that are
// interpolated one by one, and the factor of small angles by its series.
#pragma once

#include <array>
#include <glm/ext/vector_double3.hpp>

#include "bakers/march/light_in_cloud.h"

namespace skybake {

struct ReferenceLight {
    double sun = 0;
    double sky = 0;
    double ground = 0;
};

// What an eye sees that looks in a direction past a place in shares of the tile. `offset` is 1 - cosine of the
// angle to the sun; of the optical depth `tau` towards it, the part `beyond` is in other layers.
ReferenceLight reference_light(const LightInCloud& light, const glm::dvec3& direction,
                               double offset, const glm::dvec3& place,
                               const std::array<double, 2>& tau_and_beyond);

}  // namespace skybake
