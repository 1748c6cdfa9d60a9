// Where the slices of a volume lie in an image.
#pragma once

#include <array>
#include <string>

#include "config/sections/files.h"

namespace skybake {

// Slices z = 0, 1, ... fill the cells of a grid row by row from the top left, each with its row
// y = 0 on top. A stack is a grid of one column.
struct SliceLayout {
    config::VolumeLayout kind = config::VolumeLayout::stack;
    int columns = 1;
    int rows = 1;          // of cells
    bool flipped = false;  // then the image is upside down as a whole: its last row is stored first
};

// For a volume of `size` voxels. `columns` is an atlas' own, or 0: chosen as
// config/assets/slice_sheet.h says.
SliceLayout volume_layout(const std::array<int, 3>& size, config::VolumeLayout kind, int columns);

// Width and height of the image.
std::array<std::int64_t, 2> image_size(const std::array<int, 3>& size, const SliceLayout& layout);

// In one line: "atlas of 12 x 11 cells of 128 x 128 texels, ...".
std::string layout_line(const std::array<int, 3>& size, const SliceLayout& layout);

}  // namespace skybake
