// Checks a solution by its energy: the light that the sun sends in must go out, into the ground or
// into the air.
//
// Over the whole planet and for a solar irradiance of 1, sunlight that is scattered or reflected
// for the first time must leave through the top, or be absorbed by air or ground after any number
// of events.
//
//   in        integral of sigma_s T_sun over the air
//             + integral of albedo mu_s T_sun over the ground
//   escaped   integral of the light's upward flux over the top
//   absorbed  integral of sigma_a 4pi Psi over the air
//             + integral of (1 - albedo) E_sky over the ground
#pragma once

#include <optional>
#include <string>

#include "bakers/air/medium.h"
#include "bakers/light/solver/solved_light.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// Energies for a solar irradiance of 1, in km^2 of area that receives this irradiance.
struct EnergyBalance {
    Spectrum in{};
    Spectrum escaped{};
    Spectrum absorbed{};
    // Returns the largest |in - escaped - absorbed| / in of a channel; 0 where nothing scatters.
    double largest_error() const;
};

EnergyBalance energy_balance(const SkyMedium& medium, const SolvedLight& light);

// Returns E0405 if orders are left out, energy is lost or light is negative. `name` is the asset's.
// No asset is made of a solution that fails.
[[nodiscard]] std::optional<Diagnostic> check_light(const EnergyBalance& balance,
                                                    const SolvedLight& light,
                                                    const std::string& name);

}  // namespace skybake
