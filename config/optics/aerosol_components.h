// Kinds of airborne particles and the mixtures that they come in, after OPAC: Hess, Koepke & Schult
// 1998 (Bull. Amer. Meteor. Soc. 79, 831). A component is a kind of particle with a log-normal
// distribution of radii and a refractive index. A mixture is a number of each per volume. Particles
// are homogeneous spheres. What they do to light is for Lorenz-Mie theory to say, not for this
// file.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "config/optics/gases.h"

namespace skybake::config {

enum class AerosolComponent {
    insoluble,              // soil and organic matter
    water_soluble,          // sulfates, nitrates, organics; swells with humidity
    soot,                   // black carbon
    sea_salt_accumulation,  // small particles of sea salt; swells
    sea_salt_coarse,        // large ones; swells
    mineral_nucleation,     // desert dust in three sizes,
    mineral_accumulation,
    mineral_coarse,
    mineral_transported,  // and dust that was carried far
    sulfate_droplets      // sulfuric acid: antarctic and stratospheric; swells
};

std::span<const AerosolComponent> all_aerosol_components();
std::string_view name_of(AerosolComponent component);

// dN / d ln r = number / (sqrt(2 pi) ln deviation) * exp(-1/2 (ln(r / mode) / ln deviation)^2),
// between the smallest and the largest radius. (OPAC's mode radius is the median of the number.)
struct LogNormalRadii {
    Length mode_radius;
    double deviation = 1;  // geometric standard deviation
    Length smallest, largest;
};

// The relative humidity is in [0, 99] percent; components that do not swell ignore it.
LogNormalRadii radii_of(AerosolComponent component, double relative_humidity_percent);

// The share of the particles' volume that is water: 1 - (dry mode radius / mode radius)^3.
double water_share(AerosolComponent component, double relative_humidity_percent);

// n + i k relative to vacuum; k >= 0 is absorption.
struct RefractiveIndex {
    double real = 1;
    double imaginary = 0;
    bool operator==(const RefractiveIndex&) const = default;
};

// Returns the wavelengths at which the component's index is known: 350 to 800 nm, or more.
WavelengthRange range_of(AerosolComponent component);

// The wavelengths at which the index is tabulated, ascending.
std::vector<Length> tabulated_wavelengths(AerosolComponent component);

// The index of the dry substance mixed with that of water by volume. It is linear in wavelength
// between the published entries. The wavelength must be in range_of(component).
RefractiveIndex refractive_index_of(AerosolComponent component, Length wavelength,
                                    double relative_humidity_percent);

// The index of pure water, 350 to 800 nm.
RefractiveIndex water_index(Length wavelength);

enum class AerosolMixture {
    continental_clean,
    continental_average,
    continental_polluted,
    urban,
    desert,
    maritime_clean,
    maritime_polluted,
    maritime_tropical,
    arctic,
    antarctic
};

struct MixturePart {
    AerosolComponent component{};
    NumberDensity particles;  // of the whole log-normal distribution, at the ground
};

// Returns the components of the mixture with their numbers near the ground.
std::span<const MixturePart> parts_of(AerosolMixture mixture);

}  // namespace skybake::config
