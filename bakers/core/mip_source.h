// A volume at half the size along each axis: level k + 1 of a mip chain from level k.
//
// Each voxel of the coarser level is the mean of what lies under it, weighted by the overlap, which
// for even sizes is the mean of eight. Where samples are voxel centres a coarse voxel covers
// [i n/m, (i + 1) n/m) fine ones, n and m the sizes; where they are lower corners it is centred on
// its sample, [(i - 1/2) n/m, (i + 1/2) n/m) about fine samples of width 1, and reaches across the
// seam into the next tile. The mean over the tile is kept in either case.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "bakers/core/volume.h"

namespace skybake {

// Half of each size, rounded down, at least 1.
std::array<int, 3> next_mip_size(const std::array<int, 3>& size);

class MipSource : public VoxelSource {
  public:
    // `centered`, per axis: samples are at voxel centres rather than lower corners.
    MipSource(std::shared_ptr<const VoxelSource> finer, const std::array<int, 3>& finer_size,
              const std::array<bool, 3>& centered);
    void fill(const VoxelBox& box, const std::vector<float*>& channels) const override;

  private:
    void fill_part(const VoxelBox& box, const std::vector<float*>& channels) const;

    std::shared_ptr<const VoxelSource> finer_;
    std::array<int, 3> finer_size_;
    std::array<int, 3> size_;
    std::array<bool, 3> centered_;
};

}  // namespace skybake
