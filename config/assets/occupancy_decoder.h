// What a [bake.NAME] of asset occupancy takes from its cloud volume, and what must hold of the two
// together.
#pragma once

#include <span>
#include <string_view>

#include "config/fields/section_decoder.h"
#include "config/parameters.h"

namespace skybake::config {

// The recipe besides the occupancy itself.
struct OccupancySources {
    std::span<const Bake> bakes;                   // of every asset
    std::span<const std::string_view> unreadable;  // names of bakes at fault, which are not there
    std::span<const Cloud> clouds;
    std::span<const Noise> noises;
};

// Fills in the number of `mips`. Reports a name of no cloud volume (E0133), a channel that it has
// not (E0134), two contents (E0129), cells that do not tile as the volume does (E0150), and what
// any volume's files must have (volume_files_decoder.h). Warns of cells that are not cubes (W0211).
void resolve_occupancy(DecodedSection& bake, const OccupancySources& sources, Decoder& decoder);

}  // namespace skybake::config
