// The water of a cloud that has grown, at the voxels of a finer volume.
//
//   density = min(1, (q / full)^(2/3))
//
// for the condensed water q, as extinction is that of a fixed number of droplets, and the water `full` that
// a parcel holds at the inversion without mixing. Between cells q is Catmull and Rom's cubic along x, then y,
// then z, kept within the two cells that it lies between, and what dry air lacks counts below 0: an edge of
// the cloud lies where q passes 0, not where a cell ends.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "bakers/clouds/resampled_volume.h"
#include "bakers/convection/convection.h"
#include "bakers/field/level.h"

namespace skybake::cloud {

class GrownVolume : public VoxelSource {
  public:
    // `size` is at least as large as the cells along each axis.
    GrownVolume(std::shared_ptr<const convection::GrownCloud> cloud,
                const std::array<int, 3>& size);

    // Boxes may reach below and above the size, where there is nothing.
    void fill(const VoxelBox& box, const std::vector<float*>& channels) const override;
    bool is_empty(const VoxelBox& box) const override;

  private:
    // The four cells along an axis that a voxel lies among, from `first` on.
    struct Taps {
        int first = 0;
        std::array<float, 4> weights{};
    };
    // The cells that a run of voxels takes.
    struct Cells {
        int first = 0;
        int count = 0;
    };
    const Taps& taps_at(std::size_t axis, int voxel) const {
        return taps_[axis][static_cast<std::size_t>(voxel)];
    }
    Cells cells_of(std::size_t axis, const VoxelBox& box) const;
    const float* row(int y, int z) const;
    void along_x(const VoxelBox& box, const float* cells, float* out) const;
    // Makes the voxels of an axis from rows or slices of `width` numbers.
    void along(std::size_t axis, const VoxelBox& box, std::size_t width, const float* from,
               float* out) const;

    std::shared_ptr<const convection::GrownCloud> cloud_;
    std::array<int, 3> size_;
    std::array<std::vector<Taps>, 3> taps_;
};

// Returns the volume that a cloud of this extent takes its density from, for a bake of a size.
CloudVolume volume_of_grown(const std::shared_ptr<const convection::GrownCloud>& grown,
                            const Cloud& cloud, const std::array<int, 3>& size);

}  // namespace skybake::cloud
