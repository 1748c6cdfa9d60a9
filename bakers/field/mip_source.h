// A volume at half the size along each axis: level k + 1 of a mip chain from level k.
//
// Each voxel of the coarser level is the mean of what lies under it in texture space, [i n/m,
// (i + 1) n/m) of the finer voxels, n and m the sizes: for even sizes the mean of eight. A runtime
// uses one texture coordinate for all levels, so this holds whatever place of the tile a voxel
// samples. Footprints end at the seam, and the mean over the tile is kept.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "bakers/field/baked.h"

namespace skybake {

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
