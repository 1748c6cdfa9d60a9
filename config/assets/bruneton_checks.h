// Checks of the sections of asset = "bruneton", which bruneton.cpp resolves.
#pragma once

#include "config/assets/file_decoder.h"
#include "config/fields/section_decoder.h"
#include "config/sections/parameters.h"

namespace skybake::config {

// Reports sub-images that do not divide the texels along u, or are too few or too small (E0142).
void check_nu(const DecodedSection& bake, const VoxelCounts& size, Decoder& decoder);

// Reports an odd number of texels along v (E0142).
void check_halves(const DecodedSection& bake, const VoxelCounts& size, Decoder& decoder);

// Reports a combined table whose A would be a fifth channel, or the second or third, which no
// runtime takes for A (E0129).
void check_combined(const DecodedSection& bake, const Parameters& recipe, Decoder& decoder);

// Reports an atmosphere that takram's parameters cannot describe (E0143).
void check_takram(const DecodedSection& bake, const Parameters& recipe, Decoder& decoder);

// Warns of values other than those that takram's loader takes for granted (W0205). The loader would
// look such a file up wrongly.
void warn_of_loader(const DecodedSection& bake, const VoxelCounts& usual_size, Decoder& decoder);

// Reports a sun's axis that CalcMySky does not have (E0110).
void check_calcmysky(const DecodedSection& bake, Decoder& decoder);

// Reports `orders = 1` for the table of orders above the first, which would have no orders (E0110).
void check_higher_orders(const DecodedSection& bake, Decoder& decoder);

}  // namespace skybake::config
