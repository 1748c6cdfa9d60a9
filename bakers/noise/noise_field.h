// A noise over the voxels of a tile, computed on demand.
#pragma once

#include <vector>

#include "bakers/field/level.h"
#include "bakers/noise/noise_plan.h"

namespace skybake::noise {

class NoiseField : public VoxelSource {
  public:
    explicit NoiseField(NoisePlan plan);
    // The box must lie within the tile.
    void fill(const VoxelBox& box, const std::vector<float*>& channels) const override;
    const NoisePlan& plan() const { return plan_; }

  private:
    NoisePlan plan_;
};

}  // namespace skybake::noise
