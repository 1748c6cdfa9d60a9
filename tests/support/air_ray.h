// A ray through air in plain trigonometry, for references that share nothing with a camera's mappings.
#pragma once

#include "bakers/light/sky_ray.h"

namespace skybake::test {

// Returns the ray from an altitude along a direction whose cosine to the zenith is `up`. `sun_up` is that
// of the direction to the sun, and `cosine_to_sun` that of the angle between both.
inline SkyRay air_ray(const Shell& shell, double altitude_km, double up, double sun_up,
                      double cosine_to_sun) {
    const double r = shell.ground_radius_km + altitude_km;
    SkyRay ray;
    ray.altitude_km = altitude_km;
    ray.s_km = r * up;
    ray.sun_s_km = r * sun_up;
    ray.cosine_to_sun = cosine_to_sun;
    ray.one_minus_cosine = 1 - cosine_to_sun;
    ray.one_plus_cosine = 1 + cosine_to_sun;
    ray.meets_ground = ray.s_km < -horizon_distance_km(shell, altitude_km);
    ray.length_km = ray_length_km(shell, altitude_km, ray.s_km, ray.meets_ground);
    return ray;
}

}  // namespace skybake::test
