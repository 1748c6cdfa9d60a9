// Whether light of all orders in an asset's air can be made in reasonable time and memory.
#pragma once

#include <optional>

#include "config/diagnostics/diagnostic.h"
#include "config/sections/parameters.h"

namespace skybake {

// Returns E0405 if the asset is made of light of all orders, which would take many minutes: the air
// scatters light very often on its way up, or it is very high above a small planet. The numbers of
// altitudes, of directions and of places along them grow with both.
std::optional<config::Diagnostic> check_solvable(const config::Atmosphere& atmosphere,
                                                 const config::Bake& bake);

}  // namespace skybake
