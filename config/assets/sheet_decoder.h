// This header checks the sheets on which images hold the slices of a volume, and fills in their layout.
#pragma once

#include "config/assets/file_decoder.h"
#include "config/fields/section_decoder.h"

namespace skybake::config {

// Reports columns beyond what a volume of this size has, or beyond what an atlas may have (E0110), and
// returns whether there are none.
bool has_good_columns(const DecodedSection& bake, const VoxelCounts& size, Decoder& decoder);

// Makes images an atlas where the recipe does not give a `layout` and a stack would be higher than
// engines import (files.h). It warns of an image that is too large for engines (W0212), or that has
// cells without a slice (W0213). Columns are good.
void resolve_sheet(DecodedSection& bake, const VoxelCounts& size, Decoder& decoder);

}  // namespace skybake::config
