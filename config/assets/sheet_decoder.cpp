#include "config/assets/sheet_decoder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "config/sections/files.h"

namespace skybake::config {
namespace {

bool has_image(const DecodedSection& bake) {
    const std::vector<FileFormat> formats = formats_of(bake);
    return std::ranges::any_of(formats,
                               [](FileFormat format) { return facts_of(format).is_image; });
}

// Returns the layout that the recipe names. If it names none, it chooses one that engines can
// import.
std::optional<SheetLayout> resolve_layout(DecodedSection& bake, const VoxelCounts& size) {
    DecodedField& decoded = bake.at("layout");
    const auto layout = choice_of<SheetLayout>(decoded);
    if (!layout) return std::nullopt;
    const bool fits = std::int64_t{size[1]} * size[2] <= largest_image_edge;
    if (decoded.source || layout == SheetLayout::atlas || fits) return layout;
    derive(decoded, chosen(*decoded.field, SheetLayout::atlas));
    return SheetLayout::atlas;
}

// Returns the place in the recipe that decides the sheet.
const Place& layout_place(const DecodedSection& bake) { return bake.place_of("columns", "layout"); }

void warn_of_large_sheet(const DecodedSection& bake, const VoxelCounts& size,
                         const SliceSheet& sheet, Decoder& decoder) {
    const auto [width, height] = sheet_size(size, sheet);
    if (std::max(width, height) <= largest_image_edge) return;
    decoder.diagnostics.warning(
        "W0212", layout_place(bake),
        fmt::format(
            "the image of [{}] has {} columns and {} rows of texels, and engines import at most {}",
            bake.path, width, height, largest_image_edge),
        sheet.columns == 1 ? "layout = \"atlas\" lays the slices side by side"
                           : "programs other than engines may read it");
}

void warn_of_empty_cells(const DecodedSection& bake, const VoxelCounts& size,
                         const SliceSheet& sheet, Decoder& decoder) {
    const int cells = sheet.columns * sheet.rows;
    if (cells == size[2]) return;
    const SliceSheet full = slice_sheet(size, SheetLayout::atlas, 0);
    const bool has_full = full.columns * full.rows == size[2];
    decoder.diagnostics.warning(
        "W0213", layout_place(bake),
        fmt::format(
            "the atlas of [{}] has {} cells for {} slices, and engines read every cell as a slice",
            bake.path, cells, size[2]),
        has_full ? fmt::format("columns = {} leaves no cell empty", full.columns)
                 : fmt::format("{} slices fill no atlas of at most {} by {} texels", size[2],
                               largest_image_edge, largest_image_edge));
}

}  // namespace

bool has_good_columns(const DecodedSection& bake, const VoxelCounts& size, Decoder& decoder) {
    const std::optional<double> columns = bake.number("columns");
    if (!columns) return true;
    const bool wide = *columns * size[0] > static_cast<double>(widest_sheet);
    if (*columns <= size[2] && !wide) return true;
    decoder.report(
        "E0110", bake, "columns", fmt::format("is out of range: {}", static_cast<int>(*columns)),
        *columns > size[2] ? fmt::format("the volume has {} slices", size[2])
                           : fmt::format("an atlas is at most {} voxels wide, which is {} columns",
                                         widest_sheet, widest_sheet / size[0]));
    return false;
}

void resolve_sheet(DecodedSection& bake, const VoxelCounts& size, Decoder& decoder) {
    if (!has_image(bake)) return;
    const auto layout = resolve_layout(bake, size);
    if (!layout) return;
    const SliceSheet sheet = slice_sheet(size, *layout, bake.whole("columns").value_or(0));
    warn_of_large_sheet(bake, size, sheet, decoder);
    warn_of_empty_cells(bake, size, sheet, decoder);
}

}  // namespace skybake::config
