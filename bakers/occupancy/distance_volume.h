// Distances and what else the data fields of voxel clouds hold, as a volume with a voxel for each
// texel.
#pragma once

#include <array>
#include <vector>

#include "bakers/field/level.h"
#include "bakers/math/bake_options.h"
#include "bakers/occupancy/cloud_bits.h"
#include "bakers/occupancy/distance_transform.h"
#include "bakers/occupancy/stored_distance.h"

namespace skybake::config {
enum class DistanceContent;
}  // namespace skybake::config

namespace skybake::occupancy {

// The inputs of the channels besides the distance.
struct DistanceFields {
    double core_m = 0;                // depth at which the profile is 1; 0: the greatest depth
    double wisp_height = 0;           // share of the volume's height at which the detail type is 1
    std::vector<float> mean_density;  // of each texel (mean_densities); empty: not asked for
};

// Returns the mean of the stored voxels of each texel, x fastest; those beyond the top are left out.
std::vector<float> mean_densities(const ChannelSource& source, const CellGrid& grid,
                                  const BakeOptions& options);

// Channels:
//   distance       metres as DistanceCode stores them
//   profile        min(1, depth / core), where depth is the distance from the texel's centre to the
//                  nearest holed cell, 0 outside of the cloud
//   detail_type    min(1, h / wisp_height), where h is the height of the texel's centre over that of
//                  the volume
//   density_scale  the mean of the texel's voxels
class DistanceSource : public VoxelSource {
  public:
    // Incomplete once options.progress is cancelled.
    DistanceSource(const VoxelBits& bits, const DistanceGrid& grid, const DistanceCode& code,
                   std::vector<config::DistanceContent> contents, DistanceFields fields,
                   const BakeOptions& options);

    void fill(const VoxelBox& box, const std::vector<float*>& channels) const override;

    const std::array<int, 3>& size() const { return size_; }
    const std::vector<float>& distances() const { return distance_; }  // as stored, x fastest

    // The depth at which the profile is 1, in metres; 0 where there is no cloud.
    double core_m() const { return fields_.core_m; }

  private:
    float value(config::DistanceContent content, std::size_t texel, int z) const;

    DistanceGrid grid_;
    std::array<int, 3> size_;
    std::vector<config::DistanceContent> contents_;
    DistanceFields fields_;
    std::vector<float> distance_;  // as stored
    std::vector<float> depth_;     // in metres; empty where no channel has it
};

}  // namespace skybake::occupancy
