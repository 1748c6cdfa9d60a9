// Whether a solution is light: what the sun sends in goes out, into the ground or into the air.
//
// Over the whole planet, for a solar irradiance of 1: sunlight that is scattered or reflected for
// the first time must leave through the top, or be absorbed by air or ground after any number of
// events.
//
//   in        integral of sigma_s T_sun over the air + integral of albedo mu_s T_sun over the
//   ground escaped   integral over the top of the light's upward flux absorbed  integral of sigma_a
//   4pi Psi over the air + integral of (1 - albedo) E_sky over the
//             ground
#pragma once

#include <optional>
#include <string>

#include "bakers/air/medium.h"
#include "bakers/light/solver/solved_light.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// In km^2: of irradiance 1 through so much area.
struct EnergyBalance {
    Spectrum in{};
    Spectrum escaped{};
    Spectrum absorbed{};
    // The largest |in - escaped - absorbed| / in of a channel; 0 where nothing scatters.
    double largest_error() const;
};

EnergyBalance energy_balance(const SkyMedium& medium, const SolvedLight& light);

// Whether what was solved for is light: before any asset is made of it.

// E0405 where orders are left out, energy is lost or light is negative. `name` of the asset.
[[nodiscard]] std::optional<config::Diagnostic> check_light(const EnergyBalance& balance,
                                                            const SolvedLight& light,
                                                            const std::string& name);

}  // namespace skybake
