#include "bakers/assets/optical_depth/column_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bakers/air/ray.h"
#include "bakers/field/image.h"
#include "bakers/math/transcendental.h"
#include "config/assets/optical_depth.h"

namespace skybake {

namespace {

constexpr auto kColumnConvention = TexelConvention::end_points_on_texel_centres;

// From a position in texels, whose centres are at whole numbers, to [0, 1].
double coordinate_of(double position, int count) {
    return count == 1 ? 0 : std::clamp(position / (count - 1), 0.0, 1.0);
}

double texture_coordinate_of(const RayTexels& texels, double x, int size) {
    return (texels.first + 0.5 + x * (texels.count - 1)) / size;
}

constexpr double kDegreesOfRadian = 180 / std::numbers::pi;

// Moves a path off the horizon. If it stays above the ground and climbs at its end, the end keeps its
// altitude.
ColumnPath path_off_the_horizon(const Shell& shell, ColumnPath path, bool ends_above) {
    const double lowest_s = lowest_s_of_sky_km(shell, path.altitude_km);
    if (path.s_km >= lowest_s) return path;
    const double ground_s = highest_s_of_ground_km(shell, path.altitude_km);
    const bool meets_ground = path.s_km + path.length_km <= 0 &&
                              path.s_km < -horizon_distance_km(shell, path.altitude_km);
    if (meets_ground && !ends_above) {
        const double r = shell.ground_radius_km + path.altitude_km;
        path.s_km = std::max(std::min(path.s_km, ground_s), -r);
        path.length_km =
            std::min(path.length_km, distance_to_ground_km(shell, path.altitude_km, path.s_km));
        return path;
    }
    const double end_km = end_altitude_km(shell, path);
    path.s_km = lowest_s;
    const double length_km = climb_distance_km(shell, path.altitude_km, lowest_s,
                                               std::max(end_km - path.altitude_km, 0.0));
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

ColumnTableKind table_kind(const config::OpticalDepthBake& bake) {
    if (bake.table == config::OpticalDepthTable::to_top) return ColumnTableKind::to_top;
    return bake.coordinates == config::BetweenCoordinates::altitudes
               ? ColumnTableKind::between_altitudes
               : ColumnTableKind::along_distance;
}

}  // namespace

double stored_of_mean_density(double mean_density) {
    return std::sqrt(std::sqrt(std::sqrt(mean_density)));
}

double mean_density_of_stored(double stored) {
    const double squared = stored * stored;
    return (squared * squared) * (squared * squared);
}

ColumnTable::ColumnTable(const config::OpticalDepthBake& bake, const ColumnGeometry& geometry)
    : kind_(table_kind(bake)), size_(bake.size), geometry_(geometry) {
    const int width = size_[0];
    const int limb = width / 2;
    if (kind_ == ColumnTableKind::along_distance) {
        const int upward = width / 4;
        kinds_ = {{RayKind::upward, 0, upward},
                  {RayKind::limb, upward, limb},
                  {RayKind::ground, upward + limb, width - upward - limb}};
    } else {
        kinds_ = {{RayKind::upward, 0, width - limb}, {RayKind::limb, width - limb, limb}};
    }
}

ColumnPath ColumnTable::path(RayKind kind, double u, double v, double w) const {
    if (kind_ == ColumnTableKind::to_top) return path_to_top(geometry_, {kind, u, v});
    if (kind_ == ColumnTableKind::between_altitudes) {
        return path_between(geometry_, {kind, u, v, w});
    }
    return path_along(geometry_, {kind, u, v, w});
}

const RayTexels& ColumnTable::texels_of(RayKind kind) const {
    return *std::ranges::find(kinds_, kind, &RayTexels::kind);
}

ColumnPath ColumnTable::path_of_texel(const std::array<int, 3>& texel) const {
    const auto along = [&](std::size_t axis) {
        return texel_coordinate(kColumnConvention, texel[axis], size_[axis]);
    };
    for (const RayTexels& texels : kinds_) {
        const int i = texel[0] - texels.first;
        if (i >= texels.count) continue;
        return path(texels.kind, coordinate_of(i, texels.count), along(1), along(2));
    }
    return {};
}

std::array<double, 3> ColumnTable::lookup_place(const std::array<double, 3>& uvw) const {
    std::array<double, 3> place = uvw;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double edge = 0.5 / size_[axis];
        place[axis] = std::clamp(place[axis], edge, 1 - edge);
    }
    double nearest = place[0];
    double distance = 1;
    for (const RayTexels& texels : kinds_) {
        const double inside = std::clamp(place[0], texture_coordinate_of(texels, 0, size_[0]),
                                         texture_coordinate_of(texels, 1, size_[0]));
        if (std::fabs(inside - place[0]) >= distance) continue;
        distance = std::fabs(inside - place[0]);
        nearest = inside;
    }
    place[0] = nearest;
    return place;
}

ColumnPath ColumnTable::path_at(const std::array<double, 3>& uvw) const {
    const auto along = [&](std::size_t axis) {
        return coordinate_of(uvw[axis] * size_[axis] - 0.5, size_[axis]);
    };
    const double position = uvw[0] * size_[0] - 0.5;
    for (const RayTexels& texels : kinds_) {
        // Half a texel beyond the last centre another kind's first half begins.
        if (texels.kind != kinds_.back().kind && position > texels.first + texels.count - 0.5) {
            continue;
        }
        return path(texels.kind, coordinate_of(position - texels.first, texels.count), along(1),
                    along(2));
    }
    return {};
}

std::array<double, 3> ColumnTable::texture_coordinates(const ColumnPath& path) const {
    const auto place = [&](RayKind kind, double u, double v, double w) {
        return std::array<double, 3>{texture_coordinate_of(texels_of(kind), u, size_[0]),
                                     texture_coordinate(kColumnConvention, v, size_[1]),
                                     texture_coordinate(kColumnConvention, w, size_[2])};
    };
    if (kind_ == ColumnTableKind::to_top) {
        const TopCoordinates x = top_coordinates(geometry_, path.altitude_km, path.s_km);
        return place(x.kind, x.angle, x.altitude, 0);
    }
    if (kind_ == ColumnTableKind::between_altitudes) {
        const PairCoordinates x = pair_coordinates(geometry_, path);
        return place(x.kind, x.angle, x.high, x.low);
    }
    const DistanceCoordinates x = distance_coordinates(geometry_, path);
    return place(x.kind, x.angle, x.altitude, x.distance);
}

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

ColumnPath column_path_of(const ColumnTable& table,
                          const std::vector<std::pair<std::string, double>>& at) {
    const Shell& shell = table.geometry().shell;
    if (table.kind() == ColumnTableKind::between_altitudes) {
        return path_of_angle(shell, at[0].second, at[1].second, at[2].second / kDegreesOfRadian);
    }
    ColumnPath path{at[0].second, (shell.ground_radius_km + at[0].second) * at[1].second, 0};
    path.length_km = table.kind() == ColumnTableKind::to_top
                         ? distance_to_top_km(shell, path.altitude_km, path.s_km)
                         : at[2].second;
    return path;
}

std::array<double, 3> column_texture_coordinates(
    const ColumnTable& table, const std::vector<std::pair<std::string, double>>& at) {
    return table.texture_coordinates(column_path_of(table, at));
}

}  // namespace skybake
