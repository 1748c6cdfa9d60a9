// This header declares particles, which are spheres in air: [particles.NAME].
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "config/optics/gases.h"
#include "config/text/quantity.h"

namespace skybake::config {

enum class ParticleMaterial { water, constant, tabulated };
enum class SizeDistribution { monodisperse, log_normal, gamma, modified_gamma };

// One [particles.NAME] describes homogeneous spheres in air, and how many of them have each radius
// r:
//   monodisperse    all have r = radius
//   log_normal      n ~ 1/r exp(-ln^2(r / radius) / (2 ln^2 geometric_deviation))
//   gamma           n ~ r^((1 - 3 v) / v) exp(-r / (effective_radius v)), v the effective variance
//   modified_gamma  n ~ r^alpha exp(-(r / radius)^gamma)
// Where there is a smallest or a largest radius, spheres beyond it are missing: numbers of
// particles count the whole distribution, as those of OPAC do.
struct Particles {
    std::string name;
    ParticleMaterial material = ParticleMaterial::water;
    double refractive_index = 1;      // constant: m = refractive_index + i absorption_index
    double absorption_index = 0;      // constant
    std::vector<IndexPoint> indices;  // tabulated: linear in wavelength, constant beyond the ends
    SizeDistribution sizes = SizeDistribution::gamma;
    Length radius;                   // all but gamma
    double geometric_deviation = 1;  // log_normal, above 1
    Length effective_radius;         // gamma: the mean radius, weighted with the cross-section
    double effective_variance = 0;   // gamma: relative to its square, in (0, 0.5)
    double alpha = 0;                // modified_gamma
    double gamma = 1;                // modified_gamma
    Length smallest_radius, largest_radius;  // all but monodisperse; 0 is no bound
    bool operator==(const Particles&) const = default;
};

// Returns the wavelengths at which the refractive index of the particles is
// known.
WavelengthRange range_of(const Particles& particles);

// This is one kind of spheres of a layer, and how many of them there are where
// its density is 1.
struct SphereKind {
    Particles particles;
    NumberDensity number_density;
    bool operator==(const SphereKind&) const = default;
};

// These are the particles of a layer where its density is 1.
struct LayerParticles {
    std::vector<SphereKind> kinds;
    // At 550 nm: either of them scales the numbers of all kinds. resolve_matter
    // (spectral_air.h) makes the extinction from the optical depth, which goes
    // from the ground to the top of the air.
    std::optional<double> optical_depth;
    std::optional<InverseLength> extinction;
    std::vector<Length> wavelengths;  // one per channel
    // Above 0, Lorenz-Mie series are summed at its multiples only, and
    // interpolated between them.
    Length step;
    bool operator==(const LayerParticles&) const = default;
};

}  // namespace skybake::config
