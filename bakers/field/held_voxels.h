// Voxels that are made once and held in memory while several passes read them: the survey, coarser
// levels, each file, and the grids that are made of a volume.
#pragma once

#include <array>
#include <memory>

#include "bakers/field/level.h"
#include "bakers/math/bake_options.h"

namespace skybake {

// Returns the voxels of `source`, as they were made, before rounding. The first pass that asks for a
// whole row along x makes it; it is then held as SparseRows, as long as all rows that are held take
// no more than options.held_voxel_bytes. Others are made again by each pass. Which of the two it is
// changes no voxel.
std::shared_ptr<const VoxelSource> held_voxels(std::shared_ptr<const VoxelSource> source,
                                               const std::array<int, 3>& size, int channels,
                                               const BakeOptions& options);

}  // namespace skybake
