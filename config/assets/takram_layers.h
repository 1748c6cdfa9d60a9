// This header sorts the layers of an atmosphere into the three kinds that takram's
// AtmosphereParameters have.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "config/sections/atmosphere.h"

namespace skybake::config {

// A pointer is null if the atmosphere has no layer of the kind.
struct TakramLayers {
    const Layer* rayleigh = nullptr;    // exponential, absorbs nothing
    const Layer* mie = nullptr;         // exponential, phase cornette_shanks
    const Layer* absorption = nullptr;  // a tent, scatters nothing
};

// Says in a few words what takram's AtmosphereParameters cannot express of the atmosphere, or
// returns none if they can express all of it.
std::optional<std::string> takram_problem(const Atmosphere& atmosphere, std::size_t channels);

// Sorts the layers of an atmosphere that has no takram_problem. The atmosphere must outlive the
// result.
TakramLayers takram_layers(const Atmosphere& atmosphere);

}  // namespace skybake::config
