// What the tables of Bruneton's scattering and of columns take from the recipe, and what must hold
// of their sizes.
#pragma once

#include "config/fields/section_decoder.h"
#include "config/parameters.h"

namespace skybake::config {

// Fills in what depends on the table, the convention and the layers. E0142: a size that the table
// cannot have.
void resolve_bruneton(DecodedSection& bake, const Parameters& recipe, Decoder& decoder);

void resolve_optical_depth(DecodedSection& bake, const Atmosphere& atmosphere, Decoder& decoder);

}  // namespace skybake::config
