// A recipe made smaller, for pictures while one is writing it.
#pragma once

#include "config/recipe/recipe.h"

namespace skybake {

// Volumes of at most `most_voxels` along an edge in their own proportions and without further
// levels of detail; tables of at most 256 x 64 and 32 x 32 texels, with a fixed size in place of an
// error to be reached, and texels of multiple scattering that may be 2 % off. Nothing else differs,
// so the look is the recipe's. Octaves too fine for so few voxels alias or vanish, which
// load_recipe would have refused of the recipe itself.
config::Recipe draft_of(config::Recipe recipe, int most_voxels);

}  // namespace skybake
