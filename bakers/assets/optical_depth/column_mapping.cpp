#include "bakers/assets/optical_depth/column_mapping.h"

#include <algorithm>
#include <cmath>

#include "bakers/math/transcendental.h"

namespace skybake {
namespace {

// A share of a range that may have no width.
double share(double part, double whole) {
    return whole > 0 ? std::clamp(part / whole, 0.0, 1.0) : 0;
}

double radius_km(const Shell& shell, double altitude_km) {
    return shell.ground_radius_km + altitude_km;
}

// Along a level ray, from its point at `altitude_km` to where it is `gain_km` higher.
double level_distance_km(const Shell& shell, double altitude_km, double gain_km) {
    return std::sqrt(square_gain_km2(shell, altitude_km, gain_km));
}

// s at an altitude where the way to a point `gain_km` higher is d = d_h - (1 - angle)^2 (d_h -
// d_0), from d^2 + 2 d s = gain (gain + 2 r).
struct Rise {
    double s_km = 0;
    double distance_km = 0;
};

Rise rise(const Shell& shell, double altitude_km, double gain_km, double angle) {
    const double r = radius_km(shell, altitude_km);
    const double level = level_distance_km(shell, altitude_km, gain_km);
    const double d = gain_km + angle * (2 - angle) * (level - gain_km);
    if (d <= 0) return {r * (1 - angle), 0};
    return {std::clamp(0.5 * (gain_km * (gain_km + 2 * r) / d - d), 0.0, r), d};
}

double rise_angle(const Shell& shell, double altitude_km, double gain_km, double distance_km) {
    const double level = level_distance_km(shell, altitude_km, gain_km);
    const double part = share(distance_km - gain_km, level - gain_km);
    return part / (1 + std::sqrt(1 - part));
}

// This is climb_distance_km of ray.h for s >= 0. It rounds level rays, which have s = 0, otherwise:
// here they are a quotient by the root, there the root itself.
double distance_of_gain_km(const Shell& shell, double altitude_km, double s_km, double gain_km) {
    const double q = square_gain_km2(shell, altitude_km, gain_km);
    return q > 0 ? q / (std::sqrt(s_km * s_km + q) + s_km) : 0;
}

// The nearest point of a path that passes it.
struct NearestPoint {
    double scaled = 0;
    double altitude_km = 0;
};

NearestPoint nearest_point(const AltitudeScale& scale, double scaled_start, double angle) {
    const double scaled = std::max((1 - angle) * (1 + angle), 0.0) * scaled_start;
    return {scaled, altitude_at(scale, scaled)};
}

double nearest_altitude_km(const Shell& shell, double altitude_km, double s_km) {
    return std::max(altitude_km - drop_to_nearest_km(shell, altitude_km, s_km), 0.0);
}

double pass_angle(const AltitudeScale& scale, double scaled_start, double nearest_km) {
    return std::sqrt(share(scaled_start - scaled_altitude(scale, nearest_km), scaled_start));
}

double from_nearest_km(const Shell& shell, double nearest_km, double altitude_km) {
    return level_distance_km(shell, nearest_km, std::max(altitude_km - nearest_km, 0.0));
}

// A path that passes its nearest point does not fall, even where rounding has that point below the
// ground. Nor does a ray along the horizon: in single precision, which the published lookup has,
// rounding moves s by up to 3e-7 of its size, and rays on the two sides have texels of their own.
bool falls_to_ground(const Shell& shell, const ColumnPath& path) {
    constexpr double rounding = 4e-7;
    return path.s_km + path.length_km <= 0 &&
           path.s_km < -(1 + rounding) * horizon_distance_km(shell, path.altitude_km);
}

// s of the ray that meets the ground after d: R^2 = r^2 + 2 s d + d^2.
double fall_s_km(const Shell& shell, double altitude_km, double angle) {
    const double rho = horizon_distance_km(shell, altitude_km);
    const double d = rho - angle * (rho - altitude_km);
    const double r = radius_km(shell, altitude_km);
    return d > 0 ? std::max(-0.5 * (rho * (rho / d) + d), -r) : -r * angle;
}

ColumnPath fall(const ColumnGeometry& geometry, const DistanceCoordinates& x, double altitude_km) {
    const double left = 1 - x.distance;
    const double end_km = altitude_at(geometry.scale, left * left * x.altitude);
    const double drop = altitude_km - end_km;
    const double q = drop * (2 * radius_km(geometry.shell, altitude_km) - drop);
    const double s = fall_s_km(geometry.shell, altitude_km, x.angle);
    const double length = q > 0 ? q / (-s + std::sqrt(std::max(s * s - q, 0.0))) : 0;
    return {altitude_km, s, length};
}

ColumnPath pass(const ColumnGeometry& geometry, const DistanceCoordinates& x, double altitude_km) {
    const NearestPoint nearest = nearest_point(geometry.scale, x.altitude, x.angle);
    const double start = -x.angle * std::sqrt(x.altitude);
    const double top = std::sqrt(1 - nearest.scaled);
    const double end = start + x.distance * (top - start);
    const double end_km = altitude_at(geometry.scale, std::min(nearest.scaled + end * end, 1.0));
    const double before = from_nearest_km(geometry.shell, nearest.altitude_km, altitude_km);
    const double after =
        std::copysign(from_nearest_km(geometry.shell, nearest.altitude_km, end_km), end);
    return {altitude_km, -before, x.distance > 0 ? std::max(after + before, 0.0) : 0};
}

// The path of the kind and the angle of `x` from an altitude, as it is scaled, up to a higher one.
template <class Coordinates>
ColumnPath path_up(const ColumnGeometry& geometry, const Coordinates& x, double scaled_low,
                   double high) {
    const Shell& shell = geometry.shell;
    const double low = altitude_at(geometry.scale, scaled_low);
    if (x.kind == RayKind::upward) {
        const Rise way = rise(shell, low, high - low, x.angle);
        return {low, way.s_km, way.distance_km};
    }
    const NearestPoint nearest = nearest_point(geometry.scale, scaled_low, x.angle);
    const double before = from_nearest_km(shell, nearest.altitude_km, low);
    return {low, -before, before + from_nearest_km(shell, nearest.altitude_km, high)};
}

}  // namespace

double scaled_altitude(const AltitudeScale& scale, double altitude_km) {
    if (altitude_km >= scale.thickness_km) return 1;
    const double whole = logarithm(1 + scale.thickness_km / scale.fine_km);
    return std::sqrt(logarithm(1 + std::max(altitude_km, 0.0) / scale.fine_km) / whole);
}

double altitude_at(const AltitudeScale& scale, double scaled) {
    if (scaled >= 1) return scale.thickness_km;
    const double whole = logarithm(1 + scale.thickness_km / scale.fine_km);
    return std::min(scale.fine_km * (exponential(scaled * scaled * whole) - 1), scale.thickness_km);
}

double end_altitude_km(const Shell& shell, const ColumnPath& path) {
    return std::clamp(altitude_along_km(shell, path.altitude_km, path.s_km, path.length_km), 0.0,
                      shell.thickness_km);
}

ColumnPath path_to_top(const ColumnGeometry& geometry, const TopCoordinates& x) {
    return path_up(geometry, x, x.altitude, geometry.shell.thickness_km);
}

TopCoordinates top_coordinates(const ColumnGeometry& geometry, double altitude_km, double s_km) {
    const Shell& shell = geometry.shell;
    const double altitude = scaled_altitude(geometry.scale, altitude_km);
    if (s_km < 0) {
        const double nearest = nearest_altitude_km(shell, altitude_km, s_km);
        return {RayKind::limb, pass_angle(geometry.scale, altitude, nearest), altitude};
    }
    const double distance = distance_to_top_km(shell, altitude_km, s_km);
    return {RayKind::upward,
            rise_angle(shell, altitude_km, shell.thickness_km - altitude_km, distance), altitude};
}

ColumnPath path_between(const ColumnGeometry& geometry, const PairCoordinates& x) {
    return path_up(geometry, x, x.low * x.high, altitude_at(geometry.scale, x.high));
}

PairCoordinates pair_coordinates(const ColumnGeometry& geometry, const ColumnPath& path) {
    const Shell& shell = geometry.shell;
    const double end_km = end_altitude_km(shell, path);
    const double end_s = path.s_km + path.length_km;
    const double low = std::min(path.altitude_km, end_km);
    const double high = std::max(path.altitude_km, end_km);
    const double scaled_low = scaled_altitude(geometry.scale, low);
    const double scaled_high = scaled_altitude(geometry.scale, high);
    PairCoordinates x{RayKind::upward, 0, scaled_high, share(scaled_low, scaled_high)};
    if (path.s_km < 0 && end_s > 0) {
        const double nearest = nearest_altitude_km(shell, path.altitude_km, path.s_km);
        x.kind = RayKind::limb;
        x.angle = pass_angle(geometry.scale, scaled_low, nearest);
    } else {
        x.angle = rise_angle(shell, low, high - low, path.length_km);
    }
    return x;
}

ColumnPath path_of_angle(const Shell& shell, double altitude_km, double other_altitude_km,
                         double angle) {
    const double low = std::min(altitude_km, other_altitude_km);
    const double gain = std::max(altitude_km, other_altitude_km) - low;
    const double r = radius_km(shell, low);
    const double half_sine = sine_and_cosine(0.5 * angle).sine;
    const double length = std::sqrt(gain * gain + 4 * r * (r + gain) * half_sine * half_sine);
    if (length <= 0) return {low, r, 0};
    return {low, 0.5 * (gain * (gain + 2 * r) / length - length), length};
}

ColumnPath path_along(const ColumnGeometry& geometry, const DistanceCoordinates& x) {
    const Shell& shell = geometry.shell;
    const double altitude = altitude_at(geometry.scale, x.altitude);
    if (x.kind == RayKind::limb) return pass(geometry, x, altitude);
    if (x.kind == RayKind::ground) return fall(geometry, x, altitude);
    const Rise way = rise(shell, altitude, shell.thickness_km - altitude, x.angle);
    const double end_km =
        altitude_at(geometry.scale, x.altitude + x.distance * x.distance * (1 - x.altitude));
    return {altitude, way.s_km,
            distance_of_gain_km(shell, altitude, way.s_km, std::max(end_km - altitude, 0.0))};
}

DistanceCoordinates distance_coordinates(const ColumnGeometry& geometry, const ColumnPath& path) {
    const Shell& shell = geometry.shell;
    const AltitudeScale& scale = geometry.scale;
    const double altitude = scaled_altitude(scale, path.altitude_km);
    const double end_km = end_altitude_km(shell, path);
    const double end = scaled_altitude(scale, end_km);
    if (falls_to_ground(shell, path)) {
        const double rho = horizon_distance_km(shell, path.altitude_km);
        const double d = distance_to_ground_km(shell, path.altitude_km, path.s_km);
        return {RayKind::ground, share(rho - d, rho - path.altitude_km), altitude,
                altitude > 0 ? 1 - std::sqrt(share(end, altitude)) : 0};
    }
    const TopCoordinates ray = top_coordinates(geometry, path.altitude_km, path.s_km);
    if (ray.kind == RayKind::upward) {
        return {ray.kind, ray.angle, altitude, std::sqrt(share(end - altitude, 1 - altitude))};
    }
    const double nearest =
        scaled_altitude(scale, nearest_altitude_km(shell, path.altitude_km, path.s_km));
    const double from = -std::sqrt(std::max(altitude - nearest, 0.0));
    const double to =
        std::copysign(std::sqrt(std::max(end - nearest, 0.0)), path.s_km + path.length_km);
    return {ray.kind, ray.angle, altitude, share(to - from, std::sqrt(1 - nearest) - from)};
}

}  // namespace skybake
