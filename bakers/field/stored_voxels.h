// The voxels of a level as a file holds them, a few at a time.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "bakers/field/baked.h"
#include "bakers/field/trilinear.h"

namespace skybake {

class StoredVoxels {
  public:
    // The level's statistics are known: one per channel.
    StoredVoxels(const Level& level, config::PixelType type) : level_(level), type_(type) {}

    std::size_t channels() const { return level_.statistics.size(); }

    // Values of the eight voxels of a lookup, [tap][channel].
    std::vector<float> at(const std::array<VoxelTap, 8>& taps) const;

  private:
    void fetch_once(const std::array<VoxelTap, 8>& taps, std::size_t tap,
                    std::vector<float>& values) const;
    void fetch(const VoxelBox& box, std::size_t from, std::vector<float>& values) const;

    const Level& level_;
    config::PixelType type_;
};

}  // namespace skybake
