// What must hold of the files of any volume, and what they take from its size.
#pragma once

#include <array>
#include <string>

#include "config/section_decoder.h"

namespace skybake::config {

using VoxelCounts = std::array<int, 3>;  // along x, y and z

// "512x512x128"
std::string spell_voxels(const VoxelCounts& size);

// Pixel types that a format has not (E0131).
void check_pixel_type(const DecodedSection& bake, Decoder& decoder);

// How a level's sizes follow from those of the one before.
enum class Halving { down, up };

// Fills in the number of `mips`. Columns and levels beyond what the size has are errors (E0110).
void resolve_volume_files(DecodedSection& bake, const VoxelCounts& size, Halving halving,
                          Decoder& decoder);

// More than 2^36 voxels are an error (E0126), at the place of the size.
void check_voxel_count(const DecodedSection& bake, const VoxelCounts& size, std::size_t channels,
                       const Place& size_place, Decoder& decoder);

}  // namespace skybake::config
