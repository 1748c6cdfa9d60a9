// The variants that a report compares for `asset = "noise_volume"`.
#pragma once

#include <array>
#include <vector>

#include "bakers/field/level.h"
#include "bakers/noise/noise_plan.h"
#include "bakers/report/sweeps/volume_sweep.h"
#include "config/assets/noise_volume.h"
#include "config/sections/noise.h"

namespace skybake {

// Returns the size that a report is about: the bake's own size, halved until measuring takes only
// seconds.
std::array<int, 3> report_size(const config::Noise& noise, const config::NoiseVolumeBake& bake,
                               bool quick);

// Returns variants of the volume of `size` voxels: other sizes, pixel types, octaves and
// compressions, and the same voxels made point by point.
VolumeSweep noise_volume_sweep(const config::Noise& noise, const config::NoiseVolumeBake& bake,
                               std::array<int, 3> size, bool quick);

// A noise as noise libraries make it, with every sample hashed on its own. A report compares it
// with the kernels that share work between voxels. The values are the same, bit for bit.
class PointwiseNoise : public VoxelSource {
  public:
    explicit PointwiseNoise(noise::NoisePlan plan);
    // The box must lie within the tile, and all channels must be wanted.
    void fill(const VoxelBox& box, const std::vector<float*>& channels) const override;

  private:
    noise::NoisePlan plan_;
};

}  // namespace skybake
