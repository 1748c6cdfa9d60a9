// One [atmosphere.layers.NAME]: its fields, its coefficients resolved to scattering and extinction.
#pragma once

#include <optional>
#include <string>

#include "config/fields/section_decoder.h"
#include "config/sections/parameters.h"

namespace skybake::config {

// Takes particles and wavelengths from the recipe. None if the layer is switched off or has no
// usable coefficients; errors are reported.
std::optional<Layer> decode_layer(const std::string& name, const Place& place, const Table& table,
                                  const Parameters& recipe, Decoder& decoder);

// Warns (W0202) of a layer that is opaque beyond reason: most often a slip of a unit.
void check_optical_depth(const Layer& layer, const Atmosphere& atmosphere, const Table& table,
                         Decoder& decoder);

}  // namespace skybake::config
