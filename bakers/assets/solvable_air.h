// Whether the light of an asset's air can be solved for in reasonable time.
#pragma once

#include <optional>

#include "config/assets/assets.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/atmosphere.h"

namespace skybake {

// Returns E0405 if the asset is made of solved light and the solution would take many minutes: the
// air scatters light very often on its way up, or it is very high above a small planet. The numbers
// of altitudes and of directions of a solution grow with both.
std::optional<config::Diagnostic> check_solvable(const config::Atmosphere& atmosphere,
                                                 const config::Bake& bake);

}  // namespace skybake
