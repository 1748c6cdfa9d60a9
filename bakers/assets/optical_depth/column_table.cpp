#include "bakers/assets/optical_depth/column_table.h"

#include <algorithm>
#include <cmath>

#include "bakers/field/texel_axis.h"
#include "config/assets/optical_depth.h"

namespace skybake {

using config::BetweenCoordinates;

namespace {

constexpr auto kColumnConvention = TexelConvention::end_points_on_texel_centres;

// From a position in texels, whose centres are at whole numbers, to [0, 1].
double coordinate_of(double position, int count) {
    return count == 1 ? 0 : std::clamp(position / (count - 1), 0.0, 1.0);
}

double texture_coordinate_of(const CourseTexels& texels, double x, int size) {
    return (texels.first + 0.5 + x * (texels.count - 1)) / size;
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
    : to_top_(bake.table == config::OpticalDepthTable::to_top),
      coordinates_(bake.coordinates),
      size_(bake.size),
      geometry_(geometry) {
    const int width = size_[0];
    const int passes = width / 2;
    if (!to_top_ && coordinates_ == BetweenCoordinates::distance) {
        const int rises = width / 4;
        courses_ = {{Course::rises, 0, rises},
                    {Course::passes, rises, passes},
                    {Course::falls, rises + passes, width - rises - passes}};
    } else {
        courses_ = {{Course::rises, 0, width - passes}, {Course::passes, width - passes, passes}};
    }
}

ColumnTableKind ColumnTable::kind() const {
    if (to_top_) return ColumnTableKind::to_top;
    return coordinates_ == BetweenCoordinates::altitudes ? ColumnTableKind::between_altitudes
                                                         : ColumnTableKind::along_distance;
}

ColumnPath ColumnTable::path(Course course, double u, double v, double w) const {
    if (to_top_) return path_to_top(geometry_, {course, u, v});
    if (coordinates_ == BetweenCoordinates::altitudes) {
        return path_between(geometry_, {course, u, v, w});
    }
    return path_along(geometry_, {course, u, v, w});
}

const CourseTexels& ColumnTable::texels_of(Course course) const {
    return *std::find_if(courses_.begin(), courses_.end(),
                         [&](const CourseTexels& texels) { return texels.course == course; });
}

ColumnPath ColumnTable::path_of_texel(const std::array<int, 3>& texel) const {
    const auto along = [&](std::size_t axis) {
        return texel_coordinate(kColumnConvention, texel[axis], size_[axis]);
    };
    for (const CourseTexels& texels : courses_) {
        const int i = texel[0] - texels.first;
        if (i >= texels.count) continue;
        return path(texels.course, coordinate_of(i, texels.count), along(1), along(2));
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
    for (const CourseTexels& texels : courses_) {
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
    for (const CourseTexels& texels : courses_) {
        // Half a texel beyond the last centre another course's first half begins.
        if (texels.course != courses_.back().course &&
            position > texels.first + texels.count - 0.5) {
            continue;
        }
        return path(texels.course, coordinate_of(position - texels.first, texels.count), along(1),
                    along(2));
    }
    return {};
}

std::array<double, 3> ColumnTable::texture_coordinates(const ColumnPath& path) const {
    const auto place = [&](Course course, double u, double v, double w) {
        return std::array<double, 3>{texture_coordinate_of(texels_of(course), u, size_[0]),
                                     texture_coordinate(kColumnConvention, v, size_[1]),
                                     texture_coordinate(kColumnConvention, w, size_[2])};
    };
    if (to_top_) {
        const TopCoordinates x = top_coordinates(geometry_, path.altitude_km, path.s_km);
        return place(x.course, x.angle, x.altitude, 0);
    }
    if (coordinates_ == BetweenCoordinates::altitudes) {
        const PairCoordinates x = pair_coordinates(geometry_, path);
        return place(x.course, x.angle, x.high, x.low);
    }
    const DistanceCoordinates x = distance_coordinates(geometry_, path);
    return place(x.course, x.angle, x.altitude, x.distance);
}

}  // namespace skybake
