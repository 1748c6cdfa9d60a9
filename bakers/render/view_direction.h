// Directions in the frame of a cloud layer: x and y along the ground, z up.
#pragma once

#include <array>

#include "bakers/math/transcendental.h"

namespace skybake {

using Direction = std::array<double, 3>;

inline double cosine_of_degrees(double degrees) { return cosine_of_turns(degrees / 360); }
inline double sine_of_degrees(double degrees) { return cosine_of_turns(degrees / 360 - 0.25); }

// Azimuths from +x towards +y.
inline Direction direction_of(double elevation_degrees, double azimuth_degrees) {
    const double level = cosine_of_degrees(elevation_degrees);
    return {level * cosine_of_degrees(azimuth_degrees), level * sine_of_degrees(azimuth_degrees),
            sine_of_degrees(elevation_degrees)};
}

inline double dot(const Direction& a, const Direction& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// 1 - cosine of the angle between two directions, without cancellation.
inline double one_minus_cosine(const Direction& a, const Direction& b) {
    const Direction d = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    return 0.5 * dot(d, d);
}

}  // namespace skybake
