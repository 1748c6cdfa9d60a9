// Directions in the frame of a cloud layer: x and y along the ground, z up.
#pragma once

#include <glm/geometric.hpp>

#include "bakers/math/transcendental.h"
#include "bakers/math/vectors.h"

namespace skybake {

inline double cosine_of_degrees(double degrees) { return cosine_of_turns(degrees / 360); }
inline double sine_of_degrees(double degrees) { return cosine_of_turns(degrees / 360 - 0.25); }

// Azimuths from +x towards +y.
inline glm::dvec3 direction_of(double elevation_degrees, double azimuth_degrees) {
    const double level = cosine_of_degrees(elevation_degrees);
    return {level * cosine_of_degrees(azimuth_degrees), level * sine_of_degrees(azimuth_degrees),
            sine_of_degrees(elevation_degrees)};
}

// 1 - cosine of the angle between two directions, without cancellation.
inline double one_minus_cosine(const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 apart = a - b;
    return 0.5 * glm::dot(apart, apart);
}

}  // namespace skybake
