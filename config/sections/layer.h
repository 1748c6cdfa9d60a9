// This header declares the layers of the air: [atmosphere.layers.NAME].
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "config/optics/gases.h"
#include "config/sections/particles.h"
#include "config/text/quantity.h"

namespace skybake::config {

enum class Profile { exponential, tent, slab, tabulated, standard };
enum class Phase { isotropic, rayleigh, henyey_greenstein, cornette_shanks, mie };

// How much there is of a gas, from the ground to the top of the air.
struct GasAmount {
    Gas gas = Gas::air;
    ColumnDensity column;
    bool operator==(const GasAmount&) const = default;
};

// An aerosol whose extinction goes with a power of the wavelength (Angstrom 1929):
// (wavelength / 550 nm)^-exponent.
struct AerosolLaw {
    std::optional<double> optical_depth;  // at 550 nm, from the ground to the top of the air; or
    InverseLength extinction;             // at 550 nm, where the density is 1
    double angstrom_exponent = 0;
    double single_scattering_albedo = 1;
    bool operator==(const AerosolLaw&) const = default;
};

// A layer is one kind of particle or gas: a density profile over altitude, times coefficients per
// channel.
struct Layer {
    std::string name;
    bool enabled = true;
    Profile profile = Profile::exponential;
    Length scale_height;                    // exponential
    Length center_altitude, half_width;     // tent
    Length bottom_altitude, top_altitude;   // slab
    std::vector<DensityPoint> table;        // tabulated: linear between entries, zero outside
    std::vector<InverseLength> scattering;  // one per channel, at density 1; empty for mie
    std::vector<InverseLength> extinction;  // one per channel, at density 1; never below scattering
    Phase phase = Phase::isotropic;
    double g = 0;                       // henyey_greenstein, cornette_shanks
    double depolarization = 0;          // rayleigh: of light scattered by 90 degrees; 0.0279 of air
    std::optional<GasAmount> gas;       // scattering and extinction follow from it, or
    std::optional<AerosolLaw> aerosol;  // from this; else they are the recipe's numbers
    LayerParticles particles;           // mie: all of them follow from these; empty for others
    bool operator==(const Layer&) const = default;
};

// Returns the density of a layer integrated over altitude from 0 to `thickness`, in metres. It uses
// closed forms.
double density_column(const Layer& layer, Length thickness);

}  // namespace skybake::config
