#include <algorithm>
#include <cmath>

#include "bakers/light/sky_ray.h"

namespace skybake {

CameraRay camera_ray(const Shell& shell, double altitude_km, const SunZenith& sun,
                     const SkyDirection& direction) {
    if (altitude_km < shell.thickness_km) {
        return {sky_ray(shell, altitude_km, sun, direction), 0};
    }
    CameraRay ray;
    SkyRay& in_air = ray.in_air;
    const double r = shell.ground_radius_km + altitude_km;
    const double top = shell.ground_radius_km + shell.thickness_km;
    const double s = r * direction.mu;
    const double gain = altitude_km - shell.thickness_km;
    // Where (r mu + x)^2 = R_top^2 - p^2 with the centre passed at p: s^2 - (r^2 - R_top^2).
    const double square = s * s - square_gain_km2(shell, shell.thickness_km, gain);
    in_air.altitude_km = shell.thickness_km;
    in_air.cosine_to_sun = direction.cosine_to_sun;
    in_air.one_minus_cosine = direction.one_minus_cosine;
    in_air.one_plus_cosine = direction.one_plus_cosine;
    if (s >= 0 || square <= 0) {
        in_air.sun_s_km = top * sun.cosine;
        return ray;
    }
    in_air.s_km = -std::sqrt(square);
    ray.distance_km = std::max(in_air.s_km - s, 0.0);  // rounding, at the top itself
    in_air.sun_s_km = r * sun.cosine + ray.distance_km * direction.cosine_to_sun;
    in_air.meets_ground = in_air.s_km < -horizon_distance_km(shell, shell.thickness_km);
    in_air.length_km = ray_length_km(shell, in_air.altitude_km, in_air.s_km, in_air.meets_ground);
    return ray;
}

}  // namespace skybake
