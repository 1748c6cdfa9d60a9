// This header declares particles, which are spheres in air: [particles.NAME].
#pragma once

#include <string>
#include <vector>

#include "config/text/quantity.h"

namespace skybake::config {

enum class ParticleMaterial { water, constant };
enum class SizeDistribution { monodisperse, log_normal, gamma, modified_gamma };

// One [particles.NAME] describes homogeneous spheres in air, and how many of them have each radius
// r:
//   monodisperse    all have r = radius
//   log_normal      n ~ 1/r exp(-ln^2(r / radius) / (2 ln^2 geometric_deviation))
//   gamma           n ~ r^((1 - 3 v) / v) exp(-r / (effective_radius v)), v the effective variance
//   modified_gamma  n ~ r^alpha exp(-(r / radius)^gamma)
struct Particles {
    std::string name;
    ParticleMaterial material = ParticleMaterial::water;
    double refractive_index = 1;  // constant: m = refractive_index + i absorption_index
    double absorption_index = 0;  // constant
    SizeDistribution sizes = SizeDistribution::gamma;
    Length radius;                   // all but gamma
    double geometric_deviation = 1;  // log_normal, above 1
    Length effective_radius;         // gamma: the mean radius, weighted with the cross-section
    double effective_variance = 0;   // gamma: relative to its square, in (0, 0.5)
    double alpha = 0;                // modified_gamma
    double gamma = 1;                // modified_gamma
    bool operator==(const Particles&) const = default;
};

// These are the particles of a layer where its density is 1.
struct LayerParticles {
    Particles particles;
    NumberDensity number_density;
    std::vector<Length> wavelengths;  // one per channel
    bool operator==(const LayerParticles&) const = default;
};

}  // namespace skybake::config
