// This header checks the files of an asset, and fills in what they take from the asset's size.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "config/fields/section_decoder.h"
#include "config/sections/forward.h"

namespace skybake::config {

using VoxelCounts = std::array<int, 3>;  // along x, y and z

// Returns the formats of a bake; none if the key has no value.
std::vector<FileFormat> formats_of(const DecodedSection& bake);

// Spells a size: "512x512x128".
std::string voxels_to_string(const VoxelCounts& size);

// Reports pixel types that a format does not have, and formats that refer to files which the asset
// does not have (E0131).
void check_pixel_type(const DecodedSection& bake, Decoder& decoder);

// Reports formats that do not hold the asset: that of volumes for a table, that of colours for another
// asset or other channels (E0131).
void check_formats(const DecodedSection& bake, bool is_table, bool has_colors, Decoder& decoder);

// Reports pixel types that code blocks of another number of channels (E0131).
void check_channels(const DecodedSection& bake, std::size_t channels, Decoder& decoder);

// Reports a pixel type that codes blocks (E0131) where `what`, as in "a table", cannot have it.
void refuse_blocks(const DecodedSection& bake, std::string_view what, Decoder& decoder);

// Says whether halving the size of one level rounds down or up to get that of the next. Slices that are
// halved by themselves keep their number.
enum class Halving { down, up, down_within_slices };

// Fills in the number of `mips`. It makes images an atlas where the recipe does not give a `layout`
// and a stack would be higher than engines import (files.h). Columns and levels beyond what the
// size has are errors (E0110). It warns of an image that is too large for engines (W0212), or that
// has cells without a slice (W0213).
void resolve_files(DecodedSection& bake, const VoxelCounts& size, Halving halving,
                   Decoder& decoder);

// Reports `mips` and `columns` beside `max_error` (E0110), which chooses what `size_key` would say.
void check_chosen_files(DecodedSection& bake, std::string_view size_key, Decoder& decoder);

// Does all that a volume of this many axes needs once its size is known: it fills in the texels
// along each axis and runs the checks above and below. It reports a size that the volume cannot
// have (E0142).
void resolve_axes_and_files(DecodedSection& bake, int axes, std::size_t channels, Decoder& decoder);

// Does all that the files of a table need. It checks pixel types and formats (E0131) and mips,
// which a table whose size is not chosen yet cannot have (E0110).
void resolve_table_files(DecodedSection& bake, Decoder& decoder);

// Warns (W0211) if a VDB file is among the formats and voxels with these edges, in metres along x,
// y and z, are not cubes. `size_place` is where the recipe gives the size.
void check_cubes(const DecodedSection& bake, const std::array<double, 3>& edges,
                 const Place& size_place, Decoder& decoder);

// Reports more than 2^36 voxels at the place of the size (E0126).
void check_voxel_count(const DecodedSection& bake, const VoxelCounts& size, std::size_t channels,
                       const Place& size_place, Decoder& decoder);

}  // namespace skybake::config
