// Distances to the cloud of a volume in memory, for the report.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bakers/assets/cloud_distance/distance_check.h"
#include "bakers/occupancy/cloud_bits.h"
#include "bakers/occupancy/marcher.h"
#include "bakers/occupancy/stored_distance.h"
#include "config/assets/cloud_distance.h"

namespace skybake {

class MeasuredDistance {
  public:
    // The arguments must outlive it.
    MeasuredDistance(const std::vector<float>& voxels, const occupancy::MarchedVolume& volume,
                     const config::CloudDistanceBake& bake);

    // Makes the texels, on one thread.
    void make();

    // Returns lookups of the texels between the eight nearest ones.
    occupancy::DistanceLookup lookup() const;
    // Returns the share of texels that hold no distance a ray could go.
    double surface_share() const;
    std::uint64_t bytes() const;
    occupancy::DistanceCheckResult check(int points) const;

  private:
    const occupancy::MarchedVolume& volume_;
    const config::CloudDistanceBake& bake_;
    std::array<double, 3> voxel_m_;
    occupancy::DistanceCode code_;
    occupancy::VoxelBits bits_;
    std::vector<float> values_;
};

}  // namespace skybake
