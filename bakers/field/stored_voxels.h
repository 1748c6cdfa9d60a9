// Sources of voxels for levels of detail: the voxels of a level as a file holds them, and a volume at half
// the size.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "bakers/field/interpolation.h"
#include "bakers/field/level.h"
#include "config/sections/pixel_types.h"

namespace skybake {

class StoredVoxels {
  public:
    // The level's statistics must be known, one per channel.
    StoredVoxels(const Level& level, PixelType type) : level_(level), type_(type) {}

    std::size_t channels() const { return level_.statistics.size(); }

    // Returns the values of the eight voxels of a lookup, [tap][channel].
    std::vector<float> at(const std::array<VoxelTap, 8>& taps) const;

  private:
    void fetch_once(const std::array<VoxelTap, 8>& taps, std::size_t tap,
                    std::vector<float>& values) const;
    void fetch(const VoxelBox& box, std::size_t from, std::vector<float>& values) const;

    const Level& level_;
    PixelType type_;
};

// The size of the next coarser level: half of each size, rounded down, at least 1.
std::array<int, 3> next_mip_size(const std::array<int, 3>& size);

// The same for slices that are levels of their own each: their number stays.
std::array<int, 3> next_slice_size(const std::array<int, 3>& size);

// A volume at half the size along each axis, or along x and y: level k + 1 of a mip chain, made from
// level k.
//
// Each coarse voxel is the mean of the finer voxels that it covers in texture space: voxel i covers
// [i n/m, (i + 1) n/m) in units of finer voxels, where n and m are the finer and the coarser size.
// For even sizes that is the mean of eight. This holds whatever place of the tile a voxel samples,
// because a runtime uses the same texture coordinate for all levels. Footprints end at the seam,
// and the mean over the tile is preserved.
class MipSource : public VoxelSource {
  public:
    // `size` is that of the level, such as next_mip_size() or next_slice_size().
    MipSource(std::shared_ptr<const VoxelSource> finer, const std::array<int, 3>& finer_size,
              const std::array<int, 3>& size);
    void fill(const VoxelBox& box, const std::vector<float*>& channels) const override;

  private:
    void fill_part(const VoxelBox& box, const VoxelBox& part,
                   const std::vector<float*>& channels) const;

    std::shared_ptr<const VoxelSource> finer_;
    std::array<int, 3> finer_size_;
    std::array<int, 3> size_;
};

}  // namespace skybake
