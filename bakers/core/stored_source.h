// A small volume held in memory.
#pragma once

#include <array>
#include <vector>

#include "bakers/core/bake_options.h"
#include "bakers/core/volume.h"

namespace skybake {

class StoredSource : public VoxelSource {
  public:
    // All voxels of `source`. Left unfinished, for whoever looks, once options.progress is
    // cancelled.
    StoredSource(const VoxelSource& source, const std::array<int, 3>& size, int channels,
                 const BakeOptions& options);
    void fill(const VoxelBox& box, const std::vector<float*>& channels) const override;

  private:
    std::array<int, 3> size_;
    std::vector<std::vector<float>> values_;  // per channel, [z][y][x]
};

}  // namespace skybake
