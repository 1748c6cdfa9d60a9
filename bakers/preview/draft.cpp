#include "bakers/preview/draft.h"

#include "bakers/assets/registry.h"

namespace skybake {

config::Recipe draft_of(config::Recipe recipe, int most_voxels) {
    for (config::Bake& bake : recipe.parameters.bakes) baker_of(bake).draft(bake, most_voxels);
    return recipe;
}

}  // namespace skybake
