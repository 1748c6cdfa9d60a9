// The [bake.NAME] sections: which asset each makes, and the asset's own fields.
#pragma once

#include <span>
#include <vector>

#include "config/parameters.h"
#include "config/section_decoder.h"

namespace skybake::config {

// In the order of the file. Bakes of unknown assets are reported and left out. `noises` and
// `clouds` are those of the recipe.
std::vector<Bake> decode_bakes(const Table& root, std::span<const Noise> noises,
                               std::span<const Cloud> clouds, Decoder& decoder);

}  // namespace skybake::config
