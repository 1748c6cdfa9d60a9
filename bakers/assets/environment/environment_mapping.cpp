#include "bakers/assets/environment/environment_mapping.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "bakers/math/transcendental.h"
#include "config/assets/environment.h"

namespace skybake {

using config::EnvironmentMapping;

namespace {

// The plane of a face: direction = (s, t) on the face, in [-1, 1] to the right and downwards.
glm::dvec3 on_face(int face, double s, double t) {
    switch (face) {
        case 0:
            return {1, -t, -s};
        case 1:
            return {-1, -t, s};
        case 2:
            return {s, 1, t};
        case 3:
            return {s, -1, -t};
        case 4:
            return {s, -t, 1};
        default:
            return {-s, -t, -1};
    }
}

struct FacePlace {
    int face;
    double s;
    double t;
};
FacePlace face_of(const glm::dvec3& d) {
    const double x = std::fabs(d.x);
    const double y = std::fabs(d.y);
    const double z = std::fabs(d.z);
    if (x >= y && x >= z) {
        return d.x > 0 ? FacePlace{0, -d.z / x, -d.y / x} : FacePlace{1, d.z / x, -d.y / x};
    }
    if (y >= z) return d.y > 0 ? FacePlace{2, d.x / y, d.z / y} : FacePlace{3, d.x / y, -d.z / y};
    return d.z > 0 ? FacePlace{4, d.x / z, -d.y / z} : FacePlace{5, -d.x / z, -d.y / z};
}

double sign_of(double value) { return value < 0 ? -1 : 1; }

// Folds one coordinate of the octahedron's square, in [-1, 1], back over its edges, where the other
// one changes its sign.
void fold_back(double& along, double& other) {
    if (std::fabs(along) <= 1) return;
    along = sign_of(along) * 2 - along;
    other = -other;
}

// The point of the octahedron |x| + |y| + |z| = 1.
glm::dvec3 on_octahedron(double right, double ahead) {
    fold_back(right, ahead);
    fold_back(ahead, right);
    const double up = 1 - std::fabs(right) - std::fabs(ahead);
    if (up >= 0) return {right, up, ahead};
    return {sign_of(right) * (1 - std::fabs(ahead)), up, sign_of(ahead) * (1 - std::fabs(right))};
}

// The direction at a place of the octahedron's square of equal areas.
glm::dvec3 on_equal_areas(double ahead, double right) {
    fold_back(ahead, right);
    fold_back(right, ahead);
    const double above = 1 - std::fabs(ahead) - std::fabs(right);
    const double r = 1 - std::fabs(above);
    const double share = r == 0 ? 1 : (std::fabs(right) - std::fabs(ahead)) / r + 1;
    const SineCosine around = sine_and_cosine(std::numbers::pi / 4 * share);
    const double level = r * std::sqrt(2 - r * r);
    return {sign_of(right) * level * around.sine, sign_of(above) * (1 - r * r),
            sign_of(ahead) * level * around.cosine};
}

// Where a direction is in that square: ahead and right.
std::array<double, 2> at_equal_area(const glm::dvec3& direction) {
    const glm::dvec3 unit = glm::normalize(direction);
    const double level = std::sqrt(unit.x * unit.x + unit.z * unit.z);
    const double r = level / std::sqrt(1 + std::fabs(unit.y));  // sqrt(1 - |up|), with all digits
    double right = r * angle_of(std::fabs(unit.x), std::fabs(unit.z)) * 2 / std::numbers::pi;
    double ahead = r - right;
    if (unit.y < 0) {
        right = 1 - right;
        ahead = 1 - ahead;
        std::swap(right, ahead);
    }
    return {sign_of(unit.z) * ahead, sign_of(unit.x) * right};
}

// The solid angle of a triangle of three vectors of any length (Van Oosterom & Strackee 1983).
double solid_angle_of_triangle(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
    a = glm::normalize(a);
    b = glm::normalize(b);
    c = glm::normalize(c);
    const double volume = std::fabs(glm::dot(a, glm::cross(b - a, c - a)));
    return 2 * angle_of(volume, 1 + glm::dot(a, b) + glm::dot(b, c) + glm::dot(c, a));
}

// The octahedron's edges run through its texels' corners and middles, and along their diagonals: so
// each quarter of a texel is two triangles that lie on one face each.
double solid_angle_on_octahedron(int columns, int column, int row) {
    const auto corner = [&](int i, int j) {  // in halves of texels
        return on_octahedron(static_cast<double>(i) / columns - 1,
                             1 - static_cast<double>(j) / columns);
    };
    double sum = 0;
    for (int j = 2 * row; j < 2 * row + 2; ++j) {
        for (int i = 2 * column; i < 2 * column + 2; ++i) {
            const bool falls = (i < columns) == (j < columns);  // the edges of this quadrant
            const glm::dvec3 p = corner(i, j), q = corner(i + 1, j);
            const glm::dvec3 r = corner(i, j + 1), s = corner(i + 1, j + 1);
            sum += falls ? solid_angle_of_triangle(p, q, r) + solid_angle_of_triangle(q, r, s)
                         : solid_angle_of_triangle(p, q, s) + solid_angle_of_triangle(p, r, s);
        }
    }
    return sum;
}

// The solid angle of the part of a face between its middle and (s, t), negative on two sides.
double solid_angle_to(double s, double t) { return angle_of(s * t, std::sqrt(s * s + t * t + 1)); }

}  // namespace

double angle_of(double y, double x) {
    const double length = std::sqrt(x * x + y * y);
    if (length == 0) return 0;
    const double across = std::min(std::fabs(y) / length, 1.0);
    const double along = std::clamp(x / length, -1.0, 1.0);
    // The arc cosine has few digits near its ends.
    double angle = arc_cosine(along);
    if (std::fabs(y) < std::fabs(x)) {
        const double small = std::numbers::pi / 2 - arc_cosine(across);
        angle = x > 0 ? small : std::numbers::pi - small;
    }
    return y < 0 ? -angle : angle;
}

glm::dvec3 direction_of_angles(const MapAngles& angles) {
    const SineCosine around = sine_and_cosine(angles.azimuth);
    const SineCosine high = sine_and_cosine(angles.elevation);
    return {high.cosine * around.sine, high.sine, high.cosine * around.cosine};
}

MapAngles angles_of(const glm::dvec3& direction) {
    const double level = std::sqrt(direction.x * direction.x + direction.z * direction.z);
    return {angle_of(direction.x, direction.z), angle_of(direction.y, level)};
}

EnvironmentLayout::EnvironmentLayout(EnvironmentMapping mapping, std::array<int, 2> size)
    : mapping_(mapping), size_(size) {}

int EnvironmentLayout::parts() const { return mapping_ == EnvironmentMapping::cube ? 6 : 1; }

glm::dvec3 EnvironmentLayout::direction(int part, double x, double y) const {
    switch (mapping_) {
        case EnvironmentMapping::cube:
            return glm::normalize(on_face(part, 2 * x - 1, 2 * y - 1));
        case EnvironmentMapping::octahedral:
            return glm::normalize(on_octahedron(2 * x - 1, 1 - 2 * y));
        case EnvironmentMapping::equal_area:
            return on_equal_areas(2 * x - 1, 1 - 2 * y);
        default:
            return direction_of_angles(
                {2 * std::numbers::pi * (x - 0.5), std::numbers::pi * (0.5 - y)});
    }
}

double EnvironmentLayout::density(double x, double y) const {
    if (mapping_ == EnvironmentMapping::longitude_latitude) {
        return std::fabs(sine_and_cosine(std::numbers::pi * (0.5 - y)).cosine);
    }
    if (mapping_ == EnvironmentMapping::equal_area) return 1;
    const glm::dvec3 p = mapping_ == EnvironmentMapping::cube ? on_face(0, 2 * x - 1, 2 * y - 1)
                                                              : on_octahedron(2 * x - 1, 1 - 2 * y);
    const double square = glm::dot(p, p);
    return 1 / (square * std::sqrt(square));
}

double EnvironmentLayout::solid_angle(int, int column, int row) const {
    const auto size = part_size();
    if (mapping_ == EnvironmentMapping::octahedral) {
        return solid_angle_on_octahedron(size.columns, column, row);
    }
    if (mapping_ == EnvironmentMapping::equal_area) {
        return 4 * std::numbers::pi / (double{1} * size.columns * size.rows);
    }
    if (mapping_ == EnvironmentMapping::longitude_latitude) {
        const auto sine_at = [&](int edge) {
            return sine_and_cosine(std::numbers::pi * (0.5 - static_cast<double>(edge) / size.rows))
                .sine;
        };
        return 2 * std::numbers::pi / size.columns * (sine_at(row) - sine_at(row + 1));
    }
    const auto edge = [&](int i) { return 2.0 * i / size.columns - 1; };
    return solid_angle_to(edge(column), edge(row)) +
           solid_angle_to(edge(column + 1), edge(row + 1)) -
           solid_angle_to(edge(column), edge(row + 1)) -
           solid_angle_to(edge(column + 1), edge(row));
}

EnvironmentLayout::At EnvironmentLayout::at(const glm::dvec3& direction) const {
    if (mapping_ == EnvironmentMapping::cube) {
        const FacePlace place = face_of(direction);
        return {place.face, 0.5 + 0.5 * place.s, 0.5 + 0.5 * place.t};
    }
    if (mapping_ == EnvironmentMapping::longitude_latitude) {
        const MapAngles angles = angles_of(direction);
        return {0, 0.5 + angles.azimuth / (2 * std::numbers::pi),
                0.5 - angles.elevation / std::numbers::pi};
    }
    if (mapping_ == EnvironmentMapping::equal_area) {
        const std::array<double, 2> place = at_equal_area(direction);
        return {0, 0.5 + 0.5 * place[0], 0.5 - 0.5 * place[1]};
    }
    const double length = std::fabs(direction.x) + std::fabs(direction.y) + std::fabs(direction.z);
    double right = direction.x / length;
    double ahead = direction.z / length;
    if (direction.y < 0) {
        right = sign_of(direction.x) * (1 - std::fabs(direction.z / length));
        ahead = sign_of(direction.z) * (1 - std::fabs(direction.x / length));
    }
    return {0, 0.5 + 0.5 * right, 0.5 - 0.5 * ahead};
}

}  // namespace skybake
