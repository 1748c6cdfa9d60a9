// The camera of a cloud picture: calculates rays from pixels, and the span of a ray within the
// cloud layer.
#pragma once

#include <array>
#include <glm/geometric.hpp>

#include "bakers/math/transcendental.h"
#include "bakers/math/vectors.h"
#include "bakers/render/cloud_view.h"

namespace skybake {

// Directions are in the coordinate system of a cloud layer: x and y along the ground, z up.
inline double cosine_of_degrees(double degrees) { return cosine_of_turns(degrees / 360); }
inline double sine_of_degrees(double degrees) { return cosine_of_turns(degrees / 360 - 0.25); }

// Azimuths are counted from +x towards +y.
inline glm::dvec3 direction_of(double elevation_degrees, double azimuth_degrees) {
    const double level = cosine_of_degrees(elevation_degrees);
    return {level * cosine_of_degrees(azimuth_degrees), level * sine_of_degrees(azimuth_degrees),
            sine_of_degrees(elevation_degrees)};
}

// 1 - cosine of the angle between two directions, without cancellation.
inline double one_minus_cosine(const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 apart = a - b;
    return 0.5 * glm::dot(apart, apart);
}

class CameraRays {
  public:
    CameraRays(const CloudCamera& camera, int width, int height);

    // Returns the direction of the ray through the middle of pixel (x, y), with row 0 at the top.
    glm::dvec3 through(double x, double y) const;

  private:
    glm::dvec3 forward_{};
    glm::dvec3 right_{};
    glm::dvec3 up_{};
    double half_width_ = 0;  // of the picture, at distance 1
    int width_ = 0;
    int height_ = 0;
};

// Returns noise in [0, 1] that depends only on the pixel and the layer. Neighbouring pixels differ
// much. Each `layer` 0, 1 ... is another pattern.
float gradient_noise(int x, int y, int layer);

// The distances at which a ray enters and leaves the layer, or its only tile if the volume does not
// repeat. The ray misses it if first > last.
struct RaySpan {
    double first_m = 0;
    double last_m = 0;
};
RaySpan span_in_layer(const CloudMedium& medium, const CloudCamera& camera,
                      const glm::dvec3& direction, double reach_m);

}  // namespace skybake
