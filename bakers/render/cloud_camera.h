// From pixels to rays through a cloud layer.
#pragma once

#include <array>
#include <glm/geometric.hpp>

#include "bakers/math/transcendental.h"
#include "bakers/math/vectors.h"
#include "bakers/render/cloud_view.h"

namespace skybake {

// Directions in the frame of a cloud layer: x and y along the ground, z up.
inline double cosine_of_degrees(double degrees) { return cosine_of_turns(degrees / 360); }
inline double sine_of_degrees(double degrees) { return cosine_of_turns(degrees / 360 - 0.25); }

// Azimuths from +x towards +y.
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

    // Through the middle of pixel (x, y), row 0 at the top.
    glm::dvec3 through(double x, double y) const;

  private:
    glm::dvec3 forward_{};
    glm::dvec3 right_{};
    glm::dvec3 up_{};
    double half_width_ = 0;  // of the picture, at distance 1
    int width_ = 0;
    int height_ = 0;
};

// In [0, 1], a function of the pixel alone; neighbours differ much. `layer` 0, 1 ... makes others.
float gradient_noise(int x, int y, int layer);

// Where a ray is within the layer, or the one tile that there is, as distances; none where first >
// last.
struct RaySpan {
    double first_m = 0;
    double last_m = 0;
};
RaySpan span_in_layer(const CloudMedium& medium, const CloudCamera& camera,
                      const glm::dvec3& direction, double reach_m);

}  // namespace skybake
