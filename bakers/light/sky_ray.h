// View directions, straight rays of a camera through the air, and the limits by which integrators
// divide such rays into pieces.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "bakers/air/ray.h"
#include "bakers/math/quadrature.h"
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

// --- Pieces --------------------------------------------------------------------------------------

// The limits by which sky_radiance.h and its fast rows (sky_row.h) divide a ray into pieces, and
// the rule that integrates a piece.
namespace ray_pieces {

inline constexpr double kLargestDepth = 1;  // optical depth of a piece, along the ray
// Light that has passed this optical depth contributes e^-25 = 1e-11 of its radiance.
inline constexpr double kLastLight = 25;
// The largest number of halvings of a piece: 2^-20 of a ray is a few metres.
inline constexpr int kMostHalvings = 20;

// Over a piece of a row of rays the vertical turns by less than this, about a degree. Along a
// horizontal ray at dusk the sun's rays graze one scale height after the other, a few degrees apart.
inline constexpr double kLongestTurn = 1.0 / 48;

// Returns the greatest length of the piece of a ray between two distances from its start, in km. It
// grows with the distance from the planet's centre only far outside of the planet: in air that is a
// hundred radii deep a ray would otherwise have thousands of pieces.
inline double longest_piece_km(const Shell& shell, double altitude_km, double s_km, double from_km,
                               double to_km) {
    const double r = shell.ground_radius_km + altitude_km;
    const double square = (r - s_km) * (r + s_km);
    const double nearest = std::max({s_km + from_km, -(s_km + to_km), 0.0});
    const double r_nearest = std::sqrt(std::max(square, 0.0) + nearest * nearest);
    return kLongestTurn * std::max(shell.ground_radius_km, 0.5 * r_nearest);
}

// Returns the greatest optical depth of a piece, from the depths at its ends, over the channels
// whose light still reaches it; nothing if no light does.
inline std::optional<double> lit_depth(const Spectrum& from, const Spectrum& to, int channels) {
    std::optional<double> depth;
    for (int c = 0; c < channels; ++c) {
        if (data(from)[c] > kLastLight) continue;
        depth = std::max(depth.value_or(0), data(to)[c] - data(from)[c]);
    }
    return depth;
}

// Returns Gauss's rule with the five nodes that integrate each piece.
inline const QuadratureRule& gauss_rule() {
    static const QuadratureRule rule = gauss_legendre(5);
    return rule;
}

}  // namespace ray_pieces

}  // namespace skybake
