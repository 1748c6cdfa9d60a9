#include "bakers/io/volume_layout.h"

#include <fmt/format.h>

namespace skybake {
namespace {

int divided_up(int count, int by) { return (count - 1) / by + 1; }

// The width grows and the height falls with the columns, so that halving finds the fewest.
int fewest_columns(const std::array<int, 3>& size) {
    int low = 1;
    int high = size[2];  // one row of cells: enough wherever anything is
    while (low < high) {
        const int middle = low + (high - low) / 2;
        const std::int64_t width = std::int64_t{middle} * size[0];
        const std::int64_t height = std::int64_t{divided_up(size[2], middle)} * size[1];
        if (width >= height) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    return low;
}

}  // namespace

SliceLayout volume_layout(const std::array<int, 3>& size, config::VolumeLayout kind, int columns) {
    if (kind == config::VolumeLayout::stack) return {kind, 1, size[2]};
    const int chosen = columns > 0 ? columns : fewest_columns(size);
    return {kind, chosen, divided_up(size[2], chosen)};
}

std::array<std::int64_t, 2> image_size(const std::array<int, 3>& size, const SliceLayout& layout) {
    return {std::int64_t{size[0]} * layout.columns, std::int64_t{size[1]} * layout.rows};
}

std::string layout_line(const std::array<int, 3>& size, const SliceLayout& layout) {
    if (layout.kind == config::VolumeLayout::stack && layout.flipped) {
        return fmt::format(
            "stack of {} slices of {} x {} texels, upside down: slice 0 last, row 0 last", size[2],
            size[0], size[1]);
    }
    if (layout.kind == config::VolumeLayout::stack) {
        return fmt::format("stack of {} slices of {} x {} texels, slice 0 first, row 0 first",
                           size[2], size[0], size[1]);
    }
    const std::string line = fmt::format(
        "atlas of {} x {} cells of {} x {} texels, {} slices row by row from the top left, row 0 "
        "first",
        layout.columns, layout.rows, size[0], size[1], size[2]);
    return layout.flipped ? line + ", all of it upside down" : line;
}

}  // namespace skybake
