#include "bakers/field/volume.h"

namespace skybake {

std::array<bool, 3> repeating_axes(std::string_view mapping) {
    const bool tile = mapping == "tile";
    const bool layer = mapping == "layer";
    return {tile || layer, tile || layer, tile};
}

bool is_looked_up_nearest(std::string_view kind) { return kind == "occupancy"; }

}  // namespace skybake
