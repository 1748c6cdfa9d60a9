// Marches rays from one place through a layer of clouds, which is flat and repeats along x and y
// unless the medium says otherwise.
//
// Directions are in the layer's coordinates: x and y along the ground, z up. Samples of a ray are
// `step_m` apart. Each ray shifts them by a jitter of its own, and those towards the sun by another.
#pragma once

#include <array>
#include <cstddef>
#include <glm/geometric.hpp>

#include "bakers/march/cloud_medium.h"
#include "bakers/march/cloud_rays.h"
#include "bakers/math/transcendental.h"
#include "bakers/math/vectors.h"

namespace skybake {

inline double cosine_of_degrees(double degrees) { return cosine_of_turns(degrees / 360); }
inline double sine_of_degrees(double degrees) { return cosine_of_turns(degrees / 360 - 0.25); }

// Azimuths are counted from +x towards +y.
struct SunDirection {
    double elevation_degrees = 0;
    double azimuth_degrees = 0;
};

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

// Returns noise in [0, 1] that depends only on the pixel and the layer. Neighbouring pixels differ
// much. Each `layer` 0, 1 ... is another pattern.
float gradient_noise(int x, int y, int layer);

// The distances at which a ray enters and leaves the layer, or its only tile if the volume does not
// repeat. The ray misses it if first > last. `position_m` is a place with x and y from the tile's
// corner and its altitude as z.
struct RaySpan {
    double first_m = 0;
    double last_m = 0;
};
RaySpan span_in_layer(const CloudMedium& medium, const glm::dvec3& position_m,
                      const glm::dvec3& direction, double reach_m);

// Returns the length of a march towards the sun. It ends where sunlight enters the layer, but it is
// not longer than the tile's longer edge, after which the same clouds repeat, or than the tile's
// diagonal if they do not repeat.
double sun_march_length_m(const CloudMedium& medium, const SunDirection& sun);

// Marches towards the sun take at most this many samples, by longer steps if need be.
inline constexpr double kSunSamples = 256;

struct MarchSteps {
    double step_m = 1;
    double light_step_m = 1;
    double reach_m = 1;
    bool leaping = true;  // uses medium.leaps; changes no result
    bool sunlit = true;   // false: no marches towards the sun
};

// Returns steps of the length of a voxel's edge, the geometric mean of its three, and a reach beyond
// which a layer that repeats shows no more.
MarchSteps usual_steps(const CloudMedium& medium, const SunDirection& sun);

class LayerMarch {
  public:
    // `medium` must outlive this object.
    LayerMarch(const CloudMedium& medium, const glm::dvec3& position_m, const SunDirection& sun,
               const MarchSteps& steps, int threads);
    // The march refers to members of this object.
    LayerMarch(const LayerMarch&) = delete;
    LayerMarch& operator=(const LayerMarch&) = delete;

    // The share of diffuse light that passes the layer.
    double through() const { return diffuse_.through; }

    // Sets ray i of a block. Jitters are in [0, 1].
    void set_ray(RayBlock& block, std::size_t i, const glm::dvec3& direction, float jitter,
                 float light_jitter) const;

    // Any thread may call it.
    void march(const RayBlock& block, RayResults& results, FetchCounts& counts) const {
        march_cloud_rays({&march_, 1}, {&block, 1}, {&results, 1}, counts);
    }

  private:
    std::vector<float> leaps_towards_sun(int threads) const;

    const CloudMedium& medium_;
    glm::dvec3 position_m_;
    MarchSteps steps_;
    glm::dvec3 sun_;
    DiffuseShare diffuse_;
    CloudMarch march_;
};

}  // namespace skybake
