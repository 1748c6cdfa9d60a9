#include "config/sections/files.h"

namespace skybake::config {
namespace {

int divided_up(int count, int by) { return (count - 1) / by + 1; }

SliceSheet sheet_of_columns(const std::array<int, 3>& size, int columns) {
    return {columns, divided_up(size[2], columns)};
}

std::int64_t longer_edge(const std::array<int, 3>& size, const SliceSheet& sheet) {
    const auto [width, height] = sheet_size(size, sheet);
    return std::max(width, height);
}

// Returns the sheet whose image is nearest to a square. All images without empty cells have equal
// areas, so it is the one with the shortest longer edge.
SliceSheet full_sheet(const std::array<int, 3>& size) {
    SliceSheet best = sheet_of_columns(size, 1);
    for (int columns = 2; columns <= size[2]; ++columns) {
        if (size[2] % columns != 0) continue;
        const SliceSheet sheet = sheet_of_columns(size, columns);
        if (longer_edge(size, sheet) <= longer_edge(size, best)) best = sheet;
    }
    return best;
}

// Returns the sheet with the fewest columns whose image is at least as wide as it is high. With
// more columns the width grows and the height falls, so halving finds them.
SliceSheet squarest_sheet(const std::array<int, 3>& size) {
    int low = 1;
    int high = size[2];  // one row of cells, which is enough if any number is
    while (low < high) {
        const int middle = low + (high - low) / 2;
        const auto [width, height] = sheet_size(size, sheet_of_columns(size, middle));
        if (width >= height) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    return sheet_of_columns(size, low);
}

}  // namespace

SliceSheet slice_sheet(const std::array<int, 3>& size, SheetLayout layout, int columns) {
    if (layout == SheetLayout::stack) return {1, size[2]};
    if (columns > 0) return sheet_of_columns(size, columns);
    const SliceSheet full = full_sheet(size);
    if (longer_edge(size, full) <= largest_image_edge) return full;
    const SliceSheet squarest = squarest_sheet(size);
    const bool fits = longer_edge(size, squarest) <= largest_image_edge;
    return fits || sheet_size(size, full)[0] > widest_sheet ? squarest : full;
}

std::array<std::int64_t, 2> sheet_size(const std::array<int, 3>& size, const SliceSheet& sheet) {
    return {std::int64_t{size[0]} * sheet.columns, std::int64_t{size[1]} * sheet.rows};
}

}  // namespace skybake::config
