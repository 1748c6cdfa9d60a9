// Voxels that are made once and held in memory while several passes read them: the survey, coarser
// levels, each file, and the grids that are made of a volume.
#pragma once

#include <array>
#include <memory>

#include "bakers/field/level.h"
#include "bakers/math/bake_options.h"
#include "config/sections/pixel_types.h"

namespace skybake {

// Returns the voxels of `source`. The first pass that asks for a whole row along x makes it; it is then
// held as SparseRows of `type`, as long as all rows that are held take no more than
// options.held_voxel_bytes. Others are made again by each pass. Which of the two it is changes no voxel
// but for the rounding to `type`: float32 for whoever needs voxels as they were made, or half for those
// who round to it themselves.
std::shared_ptr<const VoxelSource> held_voxels(std::shared_ptr<const VoxelSource> source,
                                               const std::array<int, 3>& size, int channels,
                                               const BakeOptions& options,
                                               config::PixelType type = config::PixelType::float32);

}  // namespace skybake
