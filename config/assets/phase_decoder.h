// What [bake.NAME] with asset = "phase" takes from the recipe.
#pragma once

#include "config/fields/section_decoder.h"
#include "config/parameters.h"

namespace skybake::config {

// Particles, or a layer of the atmosphere, of that name, one of them (E0138, E0140, E0141).
void check_phase(const DecodedSection& bake, const Parameters& recipe, Decoder& decoder);

}  // namespace skybake::config
