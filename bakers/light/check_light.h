// Whether what was solved for is light: before any asset is made of it.
#pragma once

#include <optional>
#include <string>

#include "bakers/light/solver/energy_balance.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// E0405 where orders are left out, energy is lost or light is negative. `name` of the asset.
[[nodiscard]] std::optional<config::Diagnostic> check_light(const EnergyBalance& balance,
                                                            const SolvedLight& light,
                                                            const std::string& name);

}  // namespace skybake
