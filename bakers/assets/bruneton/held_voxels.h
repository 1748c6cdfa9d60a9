// Voxels that stand in memory.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "bakers/field/baked.h"

namespace skybake {

class HeldVoxels : public VoxelSource {
  public:
    HeldVoxels(const std::array<int, 3>& size, std::size_t channels);

    void fill(const VoxelBox& box, const std::vector<float*>& channels) const override;

    const std::array<int, 3>& size() const { return size_; }
    std::size_t channels() const { return values_.size(); }
    std::size_t offset(int x, int y, int z) const;
    std::vector<float>& channel(std::size_t c) { return values_[c]; }
    const std::vector<float>& channel(std::size_t c) const { return values_[c]; }
    double largest(std::size_t channel) const;

  private:
    std::array<int, 3> size_;
    std::vector<std::vector<float>> values_;  // per channel, [z][y][x]
};

}  // namespace skybake
