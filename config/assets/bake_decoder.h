// The [bake.NAME] sections: which asset each makes, and the asset's own fields.
#pragma once

#include <vector>

#include "config/fields/section_decoder.h"
#include "config/sections/parameters.h"

namespace skybake::config {

// In the order of the file. Bakes of unknown assets are reported and left out. `recipe` is all of
// it but the bakes.
std::vector<Bake> decode_bakes(const Table& root, const Parameters& recipe, Decoder& decoder);

}  // namespace skybake::config
