// Volumes of pixel types that code blocks of voxels (config::is_block_coded): what their voxels are
// after coding and decoding, and the blocks themselves.
//
// An asset of such a type *is* its decoded voxels. Statistics, probes, content hash and certificate
// are of them, and a file of any format that holds the type holds them. Values are not rounded any
// further; they are hashed as floats.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <string>

#include "bakers/field/level.h"
#include "config/sections/pixel_types.h"

namespace skybake {

struct Baked;

// Returns the bytes of a block of 4 x 4 texels, with all its channels: 8 for bc4, else 16.
constexpr std::size_t bytes_per_block(PixelType type) { return type == PixelType::bc4 ? 8 : 16; }

// Makes the voxels of a level and codes them: blocks of `box` in the order x, y, z. The box begins
// at a block and ends at one or at the volume's edge, whose blocks are filled with the last voxels.
std::string coded_blocks(const VoxelSource& voxels, const std::array<int, 3>& size, PixelType type,
                         std::size_t channels, const VoxelBox& box);

// Returns the voxels of a level as they are after coding. A voxel that the type cannot hold stays as
// it is, so that a survey finds it.
std::shared_ptr<const VoxelSource> decoded_voxels(std::shared_ptr<const VoxelSource> voxels,
                                                  const std::array<int, 3>& size, PixelType type,
                                                  std::size_t channels);

// Has all levels of a volume hold decoded voxels, and their voxels before coding as
// Level::uncoded. Volumes of other pixel types stay as they are.
void code_levels(Baked& volume);

}  // namespace skybake
