// A small volume held in memory.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "bakers/field/baked.h"
#include "bakers/math/bake_options.h"

namespace skybake {

class StoredSource : public VoxelSource {
  public:
    // All voxels of `source`; `step` is what the making is called in progress. Left unfinished, for
    // whoever looks, once options.progress is cancelled.
    StoredSource(const VoxelSource& source, const std::array<int, 3>& size, int channels,
                 const BakeOptions& options, std::string_view step);
    void fill(const VoxelBox& box, const std::vector<float*>& channels) const override;

  private:
    std::array<int, 3> size_;
    std::vector<std::vector<float>> values_;  // per channel, [z][y][x]
};

}  // namespace skybake
