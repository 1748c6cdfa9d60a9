// Marches rays from one place through layers of clouds, which are flat and repeat along x and y
// unless a medium says otherwise.
//
// Directions are in the layer's coordinates: x and y along the ground, z up. Samples of a ray are
// `step_m` apart. Each ray shifts them by a jitter of its own, and those towards the sun by another.
#pragma once

#include <cstddef>
#include <glm/geometric.hpp>
#include <span>
#include <vector>

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

// A ray from a place, with the jitters of its samples and of those towards the sun, in [0, 1].
struct LayerRay {
    glm::dvec3 position_m{};
    glm::dvec3 direction{};
    double sun_offset = 0;  // 1 - cosine of the angle between ray and sun
    float jitter = 0;
    float light_jitter = 0;
};

// Sets ray i of a march's block, up to `reach_m`.
void set_layer_ray(const CloudMarch& march, const LayerRay& ray, double reach_m, RayBlock& block,
                   std::size_t i);

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

// The geometric mean of a voxel's three edges.
double voxel_edge_m(const CloudMedium& medium);

// Rays take two samples for each voxel where the optical depth along its edge, at density 1, is above this.
// A draft's voxels are so deep: most of what a ray sees of a cloud lies in one or two of them, and with one
// sample each the cloud's light had the grain of their jitter.
inline constexpr double kDeepVoxel = 3;

// A layer that repeats fades to nothing from this share of its reach on, and does not end at it.
inline constexpr double kFadeFrom = 0.67;

// The elevation below or above a camera's horizontal at which such a layer ends, in degrees, unless that is nearer
// than its usual reach or farther than farthest_reach_m.
inline constexpr double kEndElevation = 1.5;
double farthest_reach_m(const CloudMedium& medium);
double reach_m_from(const CloudMedium& medium, double altitude_m);

// Returns steps of the length of a voxel's edge, along rays of half of it if voxels are deep, and a reach
// beyond which a layer that repeats shows no more.
MarchSteps usual_steps(const CloudMedium& medium, const SunDirection& sun);

// The same for pictures for people: steps towards the sun are longer, and in layers of thin voxels, whose optical
// depth at density 1 is below kThinVoxel, all steps are longer by what is missing, at most twice as long.
inline constexpr double kLongerSunStep = 1.5;
inline constexpr double kThinVoxel = 0.5;
MarchSteps picture_steps(const CloudMedium& medium, const SunDirection& sun);

// Returns the march by these steps through a medium, without its origin. `solved` is the light within it;
// null: that of octaves and `diffuse`.
CloudMarch march_through(const CloudMedium& medium, const MarchSteps& steps,
                         const DiffuseShare& diffuse, const LightInCloud* solved,
                         const SunDirection& sun, int threads);

// Sets the place from which all rays of a march come.
void set_origin(const glm::dvec3& position_m, CloudMarch& march);

// Layers of clouds as rays from one place see them. They may overlap in altitude.
class LayerMarch {
  public:
    // A layer and the steps through it.
    struct Layer {
        const CloudMedium* medium = nullptr;  // must outlive this object
        MarchSteps steps;
        const LightInCloud* solved = nullptr;  // null: the light of octaves
    };
    LayerMarch(std::vector<Layer> layers, const glm::dvec3& position_m, const SunDirection& sun,
               int threads);
    // The marches refer to members of this object.
    LayerMarch(const LayerMarch&) = delete;
    LayerMarch& operator=(const LayerMarch&) = delete;

    std::size_t layers() const { return layers_.size(); }

    // The share of diffuse light that passes a layer.
    double through(std::size_t layer) const { return diffuse_[layer].through; }

    // Sets ray i of the blocks, one for each layer. Jitters are in [0, 1].
    void set_ray(std::span<RayBlock> blocks, std::size_t i, const glm::dvec3& direction,
                 float jitter, float light_jitter) const;

    // March rays through all layers, in the order of depth, or through one of them alone. Any thread
    // may call them.
    void march(std::span<const RayBlock> blocks, std::span<RayResults> results,
               FetchCounts& counts) const {
        march_cloud_rays(marches_, blocks, results, counts);
    }
    void march_one(std::size_t layer, const RayBlock& block, RayResults& results,
                   FetchCounts& counts) const {
        march_cloud_rays({&marches_[layer], 1}, {&block, 1}, {&results, 1}, counts);
    }

  private:
    std::vector<Layer> layers_;
    glm::dvec3 position_m_;
    glm::dvec3 sun_;
    std::vector<DiffuseShare> diffuse_;
    std::vector<CloudMarch> marches_;
};

}  // namespace skybake
