// Voxels that are made once and held in memory while several passes read them: the survey, coarser
// levels, each file, and the grids that are made of a volume.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "bakers/field/baked.h"
#include "bakers/field/stored_voxels.h"
#include "bakers/math/bake_options.h"

namespace skybake {

// Memory for voxels, which counts towards BakeOptions::held_voxel_bytes while it exists.
class VoxelMemory {
  public:
    explicit VoxelMemory(std::int64_t bytes);
    ~VoxelMemory();
    VoxelMemory(const VoxelMemory&) = delete;
    VoxelMemory& operator=(const VoxelMemory&) = delete;

    // The bytes of all that exist in this process.
    static std::int64_t total();

  private:
    std::int64_t bytes_;
};

// Reads all voxels of `source` and returns them, as they were made, before rounding. It returns
// `source` itself if they do not fit, which then makes them for each pass. Which of the two it is
// changes no voxel. The voxels are incomplete once options.progress is cancelled, so callers must
// check it.
std::shared_ptr<const VoxelSource> held_voxels(std::shared_ptr<const VoxelSource> source,
                                               const std::array<int, 3>& size, int channels,
                                               const BakeOptions& options);

}  // namespace skybake
