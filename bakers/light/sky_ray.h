// Straight rays of a camera through the air, with the sun.
#pragma once

#include <cmath>

#include "bakers/air/ray.h"
#include "bakers/light/sky_direction.h"

namespace skybake {

// The part of a view ray that is in the air. Whether it meets the ground is told, not found out:
// next to the horizon rounding would decide about it.
struct SkyRay {
    double altitude_km = 0;  // where it begins, in [0, thickness]
    double s_km = 0;         // r mu there
    double length_km = 0;    // to its end; 0 where it misses the air
    bool meets_ground = false;
    double sun_s_km = 0;  // r mu_s where it begins
    double cosine_to_sun = 0;
    double one_minus_cosine = 0;
    double one_plus_cosine = 0;
};

// How far from the beginning a ray goes that is told by altitude and s.
inline double ray_length_km(const Shell& shell, double altitude_km, double s_km,
                            bool meets_ground) {
    return meets_ground ? distance_to_ground_km(shell, altitude_km, s_km)
                        : distance_to_top_km(shell, altitude_km, s_km);
}

// From a camera in the air. Rays below the horizon meet the ground.
inline SkyRay sky_ray(const Shell& shell, double altitude_km, const SunZenith& sun,
                      const SkyDirection& direction) {
    SkyRay ray;
    ray.altitude_km = altitude_km;
    const double r = shell.ground_radius_km + altitude_km;
    ray.s_km = r * direction.mu;
    ray.meets_ground = ray.s_km < -horizon_distance_km(shell, altitude_km);
    ray.length_km = ray_length_km(shell, altitude_km, ray.s_km, ray.meets_ground);
    ray.sun_s_km = r * sun.cosine;
    ray.cosine_to_sun = direction.cosine_to_sun;
    ray.one_minus_cosine = direction.one_minus_cosine;
    ray.one_plus_cosine = direction.one_plus_cosine;
    return ray;
}

}  // namespace skybake
