// Assets whose texels are blocks of a volume's voxels: where they lie, and what they are called.
#pragma once

#include <string>
#include <string_view>

#include "bakers/field/conventions.h"
#include "bakers/occupancy/cell_grid.h"

namespace skybake {

struct Baked;

// How files speak of the blocks.
struct BlockWords {
    std::string_view block;  // "cell" or "texel"; constants of the axes begin with it
    std::string place;       // where block i of an axis is, behind "repeats; " or "clamped; "
    AxisFilter filter = AxisFilter::linear;
};

// Fills in what says where the blocks of `of` lie: mapping, axes, edges, corner and conventions. Blocks
// go on beyond the volume where they do not divide it.
void place_blocks(const Baked& of, const occupancy::CellGrid& grid, const BlockWords& words,
                  Baked& volume);

}  // namespace skybake
