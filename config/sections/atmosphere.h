// The planet, its air and the layers of that: [atmosphere] and [atmosphere.layers.NAME].
#pragma once

#include <string>
#include <vector>

#include "config/sections/particles.h"
#include "config/text/quantity.h"

namespace skybake::config {

enum class Profile { exponential, tent, slab, tabulated };
enum class Phase { isotropic, rayleigh, henyey_greenstein, cornette_shanks, mie };

// One kind of particle or gas: a density profile over altitude times coefficients per channel.
struct Layer {
    std::string name;
    bool enabled = true;
    Profile profile = Profile::exponential;
    Length scale_height;                    // exponential
    Length center_altitude, half_width;     // tent
    Length bottom_altitude, top_altitude;   // slab
    std::vector<DensityPoint> table;        // tabulated: linear between, zero outside
    std::vector<InverseLength> scattering;  // one per channel, at density 1; none of mie
    std::vector<InverseLength> extinction;  // one per channel, at density 1; never below scattering
    Phase phase = Phase::isotropic;
    double g = 0;              // henyey_greenstein, cornette_shanks
    LayerParticles particles;  // mie: scattering, extinction and phase function follow from them
};

struct Atmosphere {
    Length ground_radius;
    Length top_radius;
    std::vector<double> ground_albedo;  // one per channel
    std::vector<Layer> layers;          // enabled ones, by name
};

// The optical depth of a layer straight up, from the ground to the top of the atmosphere: printed
// by `show`, so that a slip of a unit is seen, and the basis of a warning. Bakers have their own.

// The layer's density integrated over altitude from 0 to `thickness`, in metres; closed forms.
double density_column(const Layer& layer, Length thickness);

// Extinction times that column, one value per channel.
std::vector<double> zenith_optical_depth(const Layer& layer, const Atmosphere& atmosphere);

}  // namespace skybake::config
