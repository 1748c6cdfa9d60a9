// View directions, and straight rays of a camera through the air.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bakers/air/ray.h"
#include "bakers/math/vectors.h"

namespace skybake {

inline constexpr double kDegreesPerRadian = 180 / std::numbers::pi;

// A view direction at a camera. The angle to the sun is held as 1 - cos and 1 + cos, which avoids
// cancellation.
struct SkyDirection {
    double mu = 0;  // cosine of the zenith angle
    double cosine_to_sun = 0;
    double one_minus_cosine = 0;
    double one_plus_cosine = 0;
};

// A sun's zenith angle by its cosine and its sine, both exact at the horizon and at the zenith.
struct SunZenith {
    double cosine = 0;
    double sine = 0;  // not negative
};

// Returns the direction from the cosine and sine of its zenith angle and the cosine of its azimuth
// from the sun.
inline SkyDirection sky_direction(const SunZenith& sun, double mu, double sine,
                                  double azimuth_cosine) {
    // Both vectors are expressed with the sun in the plane of z and "forward", z up: 1 -+ cos = |a
    // -+ b|^2 / 2.
    const double along = sine * azimuth_cosine;
    const double across_squared = sine * sine * (1 - azimuth_cosine) * (1 + azimuth_cosine);
    const auto half_square = [&](double up, double forward) {
        return 0.5 * (up * up + forward * forward + across_squared);
    };
    SkyDirection direction;
    direction.mu = mu;
    direction.cosine_to_sun = mu * sun.cosine + along * sun.sine;
    direction.one_minus_cosine = half_square(mu - sun.cosine, along - sun.sine);
    direction.one_plus_cosine = half_square(mu + sun.cosine, along + sun.sine);
    return direction;
}

// The part of a view ray that is in the air. The caller states whether the ray meets the ground,
// since rounding would decide about it next to the horizon.
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

// Returns the length of the ray that starts at an altitude with s = r mu.
inline double ray_length_km(const Shell& shell, double altitude_km, double s_km,
                            bool meets_ground) {
    return meets_ground ? distance_to_ground_km(shell, altitude_km, s_km)
                        : distance_to_top_km(shell, altitude_km, s_km);
}

// Returns the ray of a camera in the air. Rays below the horizon meet the ground.
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

// A view ray of a camera anywhere above the ground.
struct CameraRay {
    SkyRay in_air;           // of length 0 where it misses the air
    double distance_km = 0;  // from the camera to where it enters the air: 0 for cameras in it
};

inline CameraRay camera_ray(const Shell& shell, double altitude_km, const SunZenith& sun,
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
    // The ray enters the air where (r mu + x)^2 = R_top^2 - p^2, p its nearest distance to the
    // centre; the right side is s^2 - (r^2 - R_top^2).
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
    ray.distance_km = std::max(in_air.s_km - s, 0.0);  // rounding may give less at the top itself
    in_air.sun_s_km = r * sun.cosine + ray.distance_km * direction.cosine_to_sun;
    in_air.meets_ground = in_air.s_km < -horizon_distance_km(shell, shell.thickness_km);
    in_air.length_km = ray_length_km(shell, in_air.altitude_km, in_air.s_km, in_air.meets_ground);
    return ray;
}

// The stretch of a ray in the planet's shadow, by distances along the ray; empty unless begin is
// below end. It is one stretch since the shadow, half a cylinder, is convex.
struct DarkStretch {
    double begin_km = 0;
    double end_km = 0;
};

// Returns the stretch of the ray that starts at an altitude with s = r mu. `sun_s_km` is r mu_s
// there. The cosine between ray and sun need not belong to a direction.
//
// The sun's ray through P grazes the ground where |P|^2 - (P . sun)^2 = R^2; along the view ray
// that is a x^2 + 2 b x + c = 0. Between the roots P is within the cylinder, on the night's side
// where P . sun < 0; as the ray is above the ground, that part of it is on one side only.
inline DarkStretch dark_stretch(const Shell& shell, double altitude_km, double s_km,
                                double length_km, double sun_s_km, double cosine_to_sun) {
    // Rounding takes the cosine of a ray along the sun's beyond 1.
    const double a = std::max((1 - cosine_to_sun) * (1 + cosine_to_sun), 0.0);
    const double b = s_km - sun_s_km * cosine_to_sun;
    const double c = altitude_km * (2 * shell.ground_radius_km + altitude_km) - sun_s_km * sun_s_km;
    const double discriminant = b * b - a * c;
    if (!(discriminant > 0) && !(c < 0)) return {};
    const double q = -(b + std::copysign(std::sqrt(discriminant), b));
    // A ray along the sun's has a root at infinity, and one through the planet's centre has two.
    const double first = c / q;
    const double second = a > 0 ? q / a : std::copysign(HUGE_VAL, q);
    const double begin = std::max(std::min(first, second), 0.0);
    const double end = std::min(std::max(first, second), length_km);
    if (!(begin < end) || 2 * sun_s_km + cosine_to_sun * (begin + end) >= 0) return {};
    return {begin, end};
}

}  // namespace skybake
