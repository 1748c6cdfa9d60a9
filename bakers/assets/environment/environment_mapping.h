// The direction that each texel of an environment shows, and the solid angle that it covers.
//
// Directions are unit vectors (right, up, ahead) of somebody who stands at the camera, as cube maps
// of GPUs have them. An image consists of one part, or of the six faces of a cube below each other;
// a part has coordinates x and y in [0, 1], from its left and upper edges.
//
//   longitude_latitude  x = 1/2 + azimuth / 360 degrees, the azimuth to the right of ahead;
//                       y = 1/2 - elevation / 180 degrees
//   cube                face +x, -x, +y, -y, +z, -z as in section 8.13 of OpenGL 4.6 and in Direct3D
//   octahedral          2 x - 1 = right / s, 1 - 2 y = ahead / s for up >= 0, with
//                       s = |right| + |up| + |ahead|; the lower half is folded out over the four
//                       edges of that square (Cigolle et al. 2014, "A Survey of Efficient
//                       Representations for Independent Unit Vectors")
//   equal_area          2 x - 1 = ahead', 1 - 2 y = right' for up >= 0, with r = sqrt(1 - up),
//                       |right'| = r (2 / pi) atan(|right| / |ahead|), |ahead'| = r - |right'|; the
//                       lower half is folded out likewise. These are the images of pbrt-v4, with x
//                       straight ahead, y to the left and z up (Clarberg 2008, "Fast Equal-Area
//                       Mapping of the (Hemi)Sphere using SIMD")
#pragma once

#include <array>
#include <glm/ext/vector_double3.hpp>

namespace skybake::config {
enum class EnvironmentMapping;
}  // namespace skybake::config

namespace skybake {

// Returns the angle of the vector (x, y) from the x axis, in [-pi, pi]; 0 for the vector 0. Its
// absolute error is below 1e-15, with the same bits on every machine.
double angle_of(double y, double x);

// An azimuth to the right of ahead and an elevation, in radians.
struct MapAngles {
    double azimuth = 0;
    double elevation = 0;
};
glm::dvec3 direction_of_angles(const MapAngles& angles);
MapAngles angles_of(const glm::dvec3& direction);

class EnvironmentLayout {
  public:
    // `size` is that of the image: of a cube n x 6 n, of an octahedron, in either mapping, n x n.
    EnvironmentLayout(config::EnvironmentMapping mapping, std::array<int, 2> size);

    config::EnvironmentMapping mapping() const { return mapping_; }
    int parts() const;
    // The texels of a part across and down.
    struct Size {
        int columns = 0;
        int rows = 0;
        bool operator==(const Size&) const = default;
    };
    Size part_size() const { return {size_[0], size_[1] / parts()}; }

    // Returns the direction at coordinates of a part. Coordinates beyond a part go on where the
    // direction does: over the poles, on a face's plane, and over the edges of the octahedron.
    glm::dvec3 direction(int part, double x, double y) const;

    // Returns the solid angle per area in (x, y), but for a factor that all texels share.
    double density(double x, double y) const;

    // Returns the solid angle of a texel of a part, in sr.
    double solid_angle(int part, int column, int row) const;

    // Where a direction is in the image.
    struct At {
        int part = 0;
        double x = 0;
        double y = 0;
    };
    At at(const glm::dvec3& direction) const;

  private:
    config::EnvironmentMapping mapping_;
    std::array<int, 2> size_;
};

}  // namespace skybake
