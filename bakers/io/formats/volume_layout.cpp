#include "bakers/io/formats/volume_layout.h"

#include <fmt/format.h>

#include "config/assets/slice_sheet.h"

namespace skybake {
SliceLayout volume_layout(const std::array<int, 3>& size, config::VolumeLayout kind, int columns) {
    const config::SliceSheet sheet = config::slice_sheet(size, kind, columns);
    return {kind, sheet.columns, sheet.rows};
}

std::array<std::int64_t, 2> image_size(const std::array<int, 3>& size, const SliceLayout& layout) {
    return config::sheet_size(size, {layout.columns, layout.rows});
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
