#include "bakers/assets/optical_depth/column_probe.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bakers/air/horizon_margin.h"
#include "bakers/math/transcendental.h"

namespace skybake {

namespace {

constexpr double kDegreesOfRadian = 180 / std::numbers::pi;

double end_altitude_km(const Shell& shell, const ColumnPath& path) {
    return std::clamp(altitude_along_km(shell, path.altitude_km, path.s_km, path.length_km), 0.0,
                      shell.thickness_km);
}

// The distance along a ray to where it climbs by `gain_km` for good.
double climb_km(const Shell& shell, double altitude_km, double s_km, double gain_km) {
    const double q = gain_km * (2 * (shell.ground_radius_km + altitude_km) + gain_km);
    const double root = std::sqrt(s_km * s_km + q);
    return s_km > 0 ? q / (root + s_km) : root - s_km;
}

// Of a path that stays above the ground and ends where it climbs, the end keeps its altitude.
ColumnPath path_off_the_horizon(const Shell& shell, ColumnPath path, bool ends_above) {
    const double lowest_s = lowest_s_of_sky_km(shell, path.altitude_km);
    if (path.s_km >= lowest_s) return path;
    const double ground_s = highest_s_of_ground_km(shell, path.altitude_km);
    const bool falls = path.s_km + path.length_km <= 0 &&
                       path.s_km < -horizon_distance_km(shell, path.altitude_km);
    if (falls && !ends_above) {
        const double r = shell.ground_radius_km + path.altitude_km;
        path.s_km = std::max(std::min(path.s_km, ground_s), -r);
        path.length_km =
            std::min(path.length_km, distance_to_ground_km(shell, path.altitude_km, path.s_km));
        return path;
    }
    const double end_km = end_altitude_km(shell, path);
    path.s_km = lowest_s;
    const double length_km =
        climb_km(shell, path.altitude_km, lowest_s, std::max(end_km - path.altitude_km, 0.0));
    path.length_km = ends_above ? length_km : std::min(path.length_km, length_km);
    return path;
}

// Between the ends of a path at the planet's centre: length^2 = gain^2 + 4 low high sin^2.
double angle_at_centre_deg(const Shell& shell, double low_km, double high_km, double length_km) {
    const double gain = high_km - low_km;
    const double square = std::max((length_km - gain) * (length_km + gain), 0.0);
    const double radii = 4 * (shell.ground_radius_km + low_km) * (shell.ground_radius_km + high_km);
    const double half_sine = std::min(std::sqrt(square / radii), 1.0);
    return (std::numbers::pi - 2 * arc_cosine(half_sine)) * kDegreesOfRadian;
}

}  // namespace

ProbePlace column_probe_place(const ColumnTable& table, const std::array<double, 3>& uvw) {
    const Shell& shell = table.geometry().shell;
    const bool along = table.kind() == ColumnTableKind::along_distance;
    const ColumnPath path =
        path_off_the_horizon(shell, table.path_at(table.lookup_place(uvw)), !along);
    ProbePlace place;
    if (table.kind() == ColumnTableKind::between_altitudes) {
        const double end_km = end_altitude_km(shell, path);
        const double low_km = std::min(path.altitude_km, end_km);
        const double high_km = std::max(path.altitude_km, end_km);
        place.at = {
            {"low_altitude_km", low_km},
            {"high_altitude_km", high_km},
            {"angle_at_centre_deg", angle_at_centre_deg(shell, low_km, high_km, path.length_km)}};
    } else {
        place.at = {{"altitude_km", path.altitude_km},
                    {"cos_zenith", path.s_km / (shell.ground_radius_km + path.altitude_km)}};
        if (along) place.at.emplace_back("length_km", path.length_km);
    }
    place.lookups = {{column_texture_coordinates(table, place.at)}};
    return place;
}

std::array<double, 3> column_texture_coordinates(
    const ColumnTable& table, const std::vector<std::pair<std::string, double>>& at) {
    const Shell& shell = table.geometry().shell;
    if (table.kind() == ColumnTableKind::between_altitudes) {
        return table.texture_coordinates(
            path_of_angle(shell, at[0].second, at[1].second, at[2].second / kDegreesOfRadian));
    }
    ColumnPath path{at[0].second, (shell.ground_radius_km + at[0].second) * at[1].second, 0};
    path.length_km = table.kind() == ColumnTableKind::to_top
                         ? distance_to_top_km(shell, path.altitude_km, path.s_km)
                         : at[2].second;
    return table.texture_coordinates(path);
}

}  // namespace skybake
