// The velocity of the flow in which a cloud has grown, at the cloud's voxels: linear between the centres of cells
// along x, then y, then z. Beyond the lowest and the highest centres it is that of the outermost cells.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "bakers/convection/convection.h"
#include "bakers/field/level.h"

namespace skybake::cloud {

class FlowField : public VoxelSource {
  public:
    // The cloud has a velocity, and stands still.
    FlowField(std::shared_ptr<const convection::GrownCloud> cloud, const std::array<int, 3>& size);

    // The channels are the velocities along x, y and z in m/s.
    void fill(const VoxelBox& box, const std::vector<float*>& channels) const override;

  private:
    // The two cells that a voxel lies between along an axis, and its distance from the first one.
    struct Taps {
        std::size_t first = 0;
        std::size_t second = 0;
        float fraction = 0;
    };
    const Taps& taps_at(std::size_t axis, int voxel) const {
        return taps_[axis][static_cast<std::size_t>(voxel)];
    }
    void fill_row(const float* velocity, int first, int y, int z, int count, float* out) const;

    std::shared_ptr<const convection::GrownCloud> cloud_;
    std::array<std::vector<Taps>, 3> taps_;
};

// The same by definition, in double precision, at a place: x and y in tiles, the height in [0, 1].
std::array<double, 3> flow_reference(const convection::GrownCloud& cloud,
                                     const std::array<double, 3>& place);

}  // namespace skybake::cloud
