// How the slices of a volume are laid out in the cells of an image.
#pragma once

#include <array>
#include <cstdint>

#include "config/sections/files.h"

namespace skybake::config {

// The most rows and columns of an image that engines import: Direct3D 11 and 12, Vulkan on common
// GPUs, Unity, Unreal and Godot take 16384, and Godot 3 aborts the import beyond.
inline constexpr int largest_image_edge = 16384;

// A row of cells is made whole: a longer one would take memory that grows with it.
inline constexpr std::int64_t widest_sheet = std::int64_t{1} << 20;

struct SliceSheet {
    int columns = 1;  // of cells
    int rows = 1;
};

// The sheet of a volume of `size` voxels. A stack has one column. An atlas has `columns`, or where
// that is 0:
//
//   the divisor of the number of slices that comes nearest to a square image, so that no cell is
//   empty: engines take the number of slices to be columns times rows;
//   where that image has an edge above largest_image_edge (a prime number of slices is one long
//   row or column), the fewest columns that make the image at least as wide as it is high, if this
//   one fits;
//   where neither fits, the divisor, unless its image is wider than widest_sheet.
//
// Of two images as near to a square the wider one is taken.
SliceSheet slice_sheet(const std::array<int, 3>& size, SheetLayout layout, int columns);

// Width and height of the image.
std::array<std::int64_t, 2> sheet_size(const std::array<int, 3>& size, const SliceSheet& sheet);

}  // namespace skybake::config
