// The layers of an atmosphere as takram's AtmosphereParameters tell them apart.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "config/sections/atmosphere.h"

namespace skybake::config {

// Null: there is none of the kind.
struct TakramLayers {
    const Layer* rayleigh = nullptr;    // exponential, absorbs nothing
    const Layer* mie = nullptr;         // exponential, phase cornette_shanks
    const Layer* absorption = nullptr;  // a tent, scatters nothing
};

// What they cannot express, in a few words, or nothing.
std::optional<std::string> takram_problem(const Atmosphere& atmosphere, std::size_t channels);

// Of an atmosphere without a problem, which must outlive them.
TakramLayers takram_layers(const Atmosphere& atmosphere);

}  // namespace skybake::config
