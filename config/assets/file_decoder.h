// What must hold of the files of an asset, and what they take from its size.
#pragma once

#include <array>
#include <string>

#include "config/fields/section_decoder.h"

namespace skybake::config {

using VoxelCounts = std::array<int, 3>;  // along x, y and z

// "512x512x128"
std::string voxels_to_string(const VoxelCounts& size);

// Pixel types that a format has not (E0131).
void check_pixel_type(const DecodedSection& bake, Decoder& decoder);

// How a level's sizes follow from those of the one before.
enum class Halving { down, up };

// Fills in the number of `mips`, and makes images an atlas where nobody has said its `layout`
// and a stack would be higher than engines import (files.h). Columns and levels beyond what
// the size has are errors (E0110). A warning tells of an image that is too large for engines
// (W0212), or that has cells without a slice (W0213).
void resolve_files(DecodedSection& bake, const VoxelCounts& size, Halving halving,
                   Decoder& decoder);

// What a volume of this many axes needs once its size is known: texels along each, and all of the
// above and below. E0142: a size that the volume cannot have.
void resolve_axes_and_files(DecodedSection& bake, int axes, std::size_t channels, Decoder& decoder);

// All that is to be done for the files of a table: pixel types and formats (E0131), and its mips,
// which a table whose size is yet to be chosen cannot have (E0110).
void resolve_table_files(DecodedSection& bake, Decoder& decoder);

// E0142 at the place of the size.
void report_size(const DecodedSection& bake, std::string message, std::string label,
                 Decoder& decoder);

// Warns (W0211) if a VDB file is among the formats and voxels of these edges, in metres along x, y
// and z, are not cubes. `size` is said at `size_place`.
void check_cubes(const DecodedSection& bake, const std::array<double, 3>& edges,
                 const Place& size_place, Decoder& decoder);

// More than 2^36 voxels are an error (E0126), at the place of the size.
void check_voxel_count(const DecodedSection& bake, const VoxelCounts& size, std::size_t channels,
                       const Place& size_place, Decoder& decoder);

}  // namespace skybake::config
