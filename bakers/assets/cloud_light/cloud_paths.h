// The reference for radiance within a cloud's layer and of the layer seen from outside: paths of light
// through the trilinearly filtered voxels as they repeat, with the true phase function.
//
// Paths go against the light, from the eye on. Free flights are sampled by delta tracking (Woodcock et
// al. 1965): within a cell of voxels, where the filtered extinction is at most m, collisions are drawn
// with the extinction m, of which the share sigma / m is real. Each collision adds the sunlight that it
// sends towards the eye; whether the sun is seen from there is decided by a flight too. Nothing is
// interpolated, stepped or cut off, so that means over paths are exact.
//
// Droplets send half of their light into a peak of a degree, and paths that happen to point to the sun
// would bring most of the light and of the noise. So each collision chooses two directions, one by the
// phase function p and one by a density q about the sun, weighted by p / (p + q) each (the balance
// heuristic: Veach & Guibas 1995). Paths go on with a probability in proportion to their weight times
// 1 + 4 pi q, the light that may be expected on them.
//
// The ground below the layer is black: what leaves the base is lost. Ground that shines is a source.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "bakers/assets/cloud_light/cloud_layer.h"
#include "bakers/assets/cloud_light/cloud_scattering.h"
#include "bakers/assets/cloud_light/sky_parts.h"
#include "bakers/light/path_tracer/path_numbers.h"
#include "bakers/math/vectors.h"

namespace skybake::cloud_light {

// The light that shines on a layer.
struct LayerSources {
    double sun = 0;                     // irradiance of a surface that faces the sun
    glm::dvec3 sun_direction{0, 0, 1};  // a unit vector towards it, which rises
    double sky = 0;                     // radiance of all directions above, but for
    SkyByDirection sky_shape = {};      // factors of it by direction; empty: 1 everywhere
    double ground = 0;                  // radiance of all directions below
};

// Means over paths, in 1/sr for an irradiance of 1.
struct TracedRadiance {
    double seen = 0;              // of sky or ground that is seen without any scattering
    double first = 0;             // sunlight that was scattered once
    double higher = 0;            // all other light
    double standard_error = 0;    // of the sum of all three
    std::int64_t collisions = 0;  // of all paths together

    double sum() const { return seen + first + higher; }
};

class CloudPaths {
  public:
    // `layer` must outlive it.
    CloudPaths(const CloudLayer& layer, const CloudScattering& scattering,
               const LayerSources& sources, int threads);

    // Traces paths from a place of the layer or on its faces, in voxel units, in the direction in which
    // the eye looks. Rays of one seed have random numbers of their own.
    TracedRadiance trace(const glm::dvec3& place, const glm::dvec3& direction, int paths,
                         std::uint64_t seed, std::uint32_t ray) const;

    // Draws a direction in which to look that serves means over the sphere, half of them about the sun, and
    // returns its density in 1/sr. Shares that are even in [0, 1) spread the directions evenly.
    double draw_direction(double share, RandomStream& random, glm::dvec3& direction) const;

    // Adds one path. It is cut off where `sum` has so many collisions.
    void walk(const glm::dvec3& place, const glm::dvec3& direction, RandomStream& random,
              TracedRadiance& sum, std::int64_t most_collisions = kUnlimited) const;

  private:
    static constexpr std::int64_t kUnlimited = std::numeric_limits<std::int64_t>::max();

    struct Particle {
        glm::dvec3 place{};
        glm::dvec3 direction{};
        double weight = 1;
        int order = 0;
    };
    bool fly(glm::dvec3& place, const glm::dvec3& direction, RandomStream& random) const;
    void walk_on(Particle particle, std::vector<Particle>& waiting, RandomStream& random,
                 TracedRadiance& sum, std::int64_t most_collisions) const;
    void add_sunlight(const Particle& particle, RandomStream& random, TracedRadiance& sum) const;
    bool choose_directions(Particle& particle, std::vector<Particle>& waiting,
                           RandomStream& random) const;
    bool survives(Particle& particle, RandomStream& random) const;
    // The radiance of sky or ground that is seen in a direction.
    double light_from(const glm::dvec3& direction) const;
    double density_about_sun(const glm::dvec3& direction) const;

    const CloudLayer& layer_;
    CloudScattering scattering_;
    LayerSources sources_;
    std::vector<PhaseFunction> about_sun_;  // q is their mean
    std::array<int, 3> cells_{};
    std::vector<double> majorants_;  // 1/m, x fastest
};

}  // namespace skybake::cloud_light
