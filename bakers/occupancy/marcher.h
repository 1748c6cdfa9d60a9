// The march of runtimes in fixed steps that leaves out what is empty, as examples/lookups/clouds.glsl has it,
// the fetches that it takes, and what it saves. Places are in voxels, in a volume that repeats along x and y.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "bakers/math/bake_options.h"
#include "bakers/occupancy/cell_grid.h"
#include "bakers/occupancy/cloud_bits.h"
#include "config/assets/occupancy_filter.h"

namespace skybake::occupancy {

using Place = std::array<double, 3>;

// The samples at from + k step for k = 0, 1 ... samples - 1, all of them within the volume's height: a march
// without skipping fetches as many densities.
struct SampledRay {
    Place from{};
    Place step{};
    int samples = 0;

    Place at(int k) const {
        return {from[0] + k * step[0], from[1] + k * step[1], from[2] + k * step[2]};
    }
};

// How many steps a ray goes on from a place, at least, through what is as empty, or as little known to be, as
// the place itself.
struct Stay {
    bool empty = false;
    double steps = 0;
};

// What a structure tells of a place on a ray.
using Structure = std::function<Stay(const Place& from, const Place& step)>;

// Tells of the box of cells that a place is in: its own cell, and leap - 1 cells about it if that is empty. The
// stay ends a 64th of a voxel before the face, so that no sample is beyond it, however floats and the weights
// of texture units, multiples of 1/256, are rounded.
struct LeapCells {
    CellGrid grid;
    const std::vector<std::uint8_t>& leaps;  // leap_distance of the grid's cells

    Stay operator()(const Place& from, const Place& step) const;
};

// What a distance to cloud tells, in steps: the sample there is empty, too, if it is more than what rounding makes
// of a distance of 0.
Stay stay_of_distance(double steps);

struct MarchFetches {
    int densities = 0;
    int structure = 0;

    int all() const { return densities + structure; }
};

// Takes the samples that need be taken, in their order: `look` is given the place and returns whether there is
// cloud. The structure is asked where the sample before had none, once until the ray's stay ends.
MarchFetches march(const SampledRay& ray, const Structure& structure,
                   const std::function<bool(const Place&)>& look);

struct SkippingGain {    // fetches of a mean ray
    double without = 0;  // one for each sample within the layer
    double with = 0;
};

// Marches 512 rays from the base to the top in steps of a voxel's shortest edge, evenly spread over the tile and
// over directions within 60 degrees of the vertical; none ends in opaque cloud. A sample has cloud where one of
// the voxels that it blends is above the threshold of the bits.
SkippingGain skipping_gain(const VoxelBits& bits, const std::array<double, 3>& voxel_m,
                           config::OccupancyFilter filter, const Structure& structure,
                           const BakeOptions& options);

}  // namespace skybake::occupancy
