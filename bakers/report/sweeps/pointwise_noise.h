// A noise as noise libraries make it, every sample hashed on its own: what a report measures the
// kernels that share work between voxels against. The values are the same, bit for bit.
#pragma once

#include <vector>

#include "bakers/field/baked.h"
#include "bakers/noise/noise_plan.h"

namespace skybake {

class PointwiseNoise : public VoxelSource {
  public:
    explicit PointwiseNoise(noise::NoisePlan plan);
    // The box lies within the tile, all channels are wanted.
    void fill(const VoxelBox& box, const std::vector<float*>& channels) const override;

  private:
    noise::NoisePlan plan_;
};

}  // namespace skybake
