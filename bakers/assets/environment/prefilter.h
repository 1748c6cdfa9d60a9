// Levels of an environment as rough surfaces reflect it.
//
// Level k of n has the roughness r = k / (n - 1), and level 0 is the map. With the normal n as view
// and reflected direction,
//
//   L_k(n) = integral of L(l) D(h) max(n.l, 0) dl / integral of D(h) max(n.l, 0) dl,   h = n + l
//
// D is GGX (Trowbridge & Reitz 1975) with alpha = r^2. This is the first sum of the split-sum
// approximation (Karis 2013, "Real Shading in Unreal Engine 4"). The integral is over 24 rings of 16
// directions of equal shares of D, each of which looks up means over a part of its solid angle (Krivanek &
// Colbert 2008, "Real-time Shading with Filtered Importance Sampling").
#pragma once

#include <vector>

#include "bakers/assets/environment/environment_mapping.h"
#include "bakers/field/image.h"
#include "bakers/math/bake_options.h"

namespace skybake {

double roughness_of_level(int level, int levels);

// How much a rough surface reflects from each direction. With x = cos^2 of the half-angle and b = 1 -
// alpha^2 the lower integral above is
//
//   4 alpha^2 integral from 1/2 to 1 of (2 x - 1) / (1 - b x)^2 dx
//     = 4 (1 - alpha^2 + 2 alpha^2 ln(2 alpha^2 / (1 + alpha^2))) / b^2,
//
// and 1 where alpha is 1, for which the lobe is max(n.l, 0) / pi.
class ReflectedLobe {
  public:
    explicit ReflectedLobe(double roughness);

    // The weight of light from a direction with this n.l, in 1/sr: 1 over all directions.
    double density(double cosine) const;

    // About the angle in which it falls to a half, in radians.
    double width() const;

  private:
    double square_;  // alpha^2
    double integral_;
};

// The maps of a mapping at one size and at all smaller ones, for lookups of means.
class MapPyramid {
  public:
    MapPyramid(config::EnvironmentMapping mapping, const Image2<float>& map);

    // Adds the light in a direction, times a weight, of means over about a solid angle in sr.
    void add(const glm::dvec3& direction, double solid_angle, double weight, double* sum) const;

    int channels() const { return maps_.front().channels; }

  private:
    void add_from(std::size_t level, const glm::dvec3& direction, double weight, double* sum) const;

    std::vector<Image2<float>> maps_;
    std::vector<EnvironmentLayout> layouts_;
};

// Returns a level of some size.
Image2<double> prefiltered(const MapPyramid& pyramid, const EnvironmentLayout& layout,
                           double roughness, const BakeOptions& options);

}  // namespace skybake
