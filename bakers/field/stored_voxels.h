// The voxels of a level as a file holds them, a few at a time.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <string_view>
#include <vector>

#include "bakers/field/baked.h"
#include "bakers/field/interpolation.h"
#include "bakers/math/bake_options.h"

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

// A small volume held in memory.
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

// A volume at half the size along each axis: level k + 1 of a mip chain from level k.
//
// Each voxel of the coarser level is the mean of what lies under it in texture space, [i n/m,
// (i + 1) n/m) of the finer voxels, n and m the sizes: for even sizes the mean of eight. A runtime
// uses one texture coordinate for all levels, so this holds whatever place of the tile a voxel
// samples. Footprints end at the seam, and the mean over the tile is kept.

// Half of each size, rounded down, at least 1.
std::array<int, 3> next_mip_size(const std::array<int, 3>& size);

class MipSource : public VoxelSource {
  public:
    MipSource(std::shared_ptr<const VoxelSource> finer, const std::array<int, 3>& finer_size);
    void fill(const VoxelBox& box, const std::vector<float*>& channels) const override;

  private:
    void fill_part(const VoxelBox& box, const VoxelBox& part,
                   const std::vector<float*>& channels) const;

    std::shared_ptr<const VoxelSource> finer_;
    std::array<int, 3> finer_size_;
    std::array<int, 3> size_;
};

}  // namespace skybake
