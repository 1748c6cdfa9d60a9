// Computes the value of cellular noise from distances. cell_tile-inl.h does the same for vectors.
#pragma once

#include <algorithm>
#include <cmath>

#include "config/sections/noise.h"

namespace skybake::noise {

inline constexpr float kOneOverSqrt3 = 0x1.279a74p-1f;

inline bool needs_no_root(config::WorleyFeature feature, config::WorleyValue form) {
    return form == config::WorleyValue::one_minus_distance_squared &&
           feature != config::WorleyFeature::f2_minus_f1;
}

// Returns the value from the squared distances to the nearest and to the second nearest point.
inline float cell_value(config::WorleyFeature feature, config::WorleyValue form, float first,
                        float second) {
    using config::WorleyFeature;
    using config::WorleyValue;
    if (needs_no_root(feature, form)) {
        return std::max(0.0f, 1 - (feature == WorleyFeature::f1 ? first : second));
    }
    float distance = std::sqrt(feature == WorleyFeature::f1 ? first : second);
    if (feature == WorleyFeature::f2_minus_f1) distance -= std::sqrt(first);
    switch (form) {
        case WorleyValue::distance:
            return distance;
        case WorleyValue::one_minus_distance:
            return std::max(0.0f, 1 - distance);
        case WorleyValue::one_minus_distance_over_sqrt3:
            return 1 - distance * kOneOverSqrt3;
        case WorleyValue::one_minus_distance_squared:
            return std::max(0.0f, 1 - distance * distance);
    }
    return distance;
}

// The two greatest bumps at a place, of which alligator noise is the difference.
//
//   bump of a point = height * s(1 - d),   s(t) = 3 t^2 - 2 t^3 for t > 0, else 0,
//
// d the distance to the point in cells. A bump ends where the cells about the place's own do.
// Side Effects Software, Houdini Development Kit, sample `alligator`.
struct GreatestBumps {
    float first = 0;
    float second = 0;

    void add(float squared_distance, float height) {
        const float t = std::max(0.0f, 1 - std::sqrt(squared_distance));
        const float bump = height * ((t * t) * (3 - 2 * t));
        second = std::max(second, std::min(first, bump));
        first = std::max(first, bump);
    }
    float value() const { return first - second; }
};

}  // namespace skybake::noise
