// Compares the distances of a texture with exact ones, found by search (cloud_bits.h).
#pragma once

#include <array>
#include <cstdint>

#include "bakers/field/conventions.h"
#include "bakers/math/bake_options.h"
#include "bakers/occupancy/cloud_bits.h"
#include "bakers/occupancy/stored_distance.h"

namespace skybake::occupancy {

// The distances of a texture, whose texels are cells of `cell` voxels.
struct DistanceTexture {
    std::array<int, 3> size{};
    const float* values = nullptr;  // as stored, x fastest
    int cell = 1;
};

// Returns the distance in metres that GPUs look up, with weights rounded to 1/256, at a place in voxels whose
// height is within the volume.
double looked_up_m(const DistanceTexture& texture, const DistanceCode& code,
                   const std::array<double, 3>& place);

struct DistanceCheckResult {
    int points = 0;  // places between texels, and as many texels
    // Lookups that are farther from 0 than the exact distance, and texels that are nearer to 0 than
    // they need be (DistanceCode::most_lost).
    int too_far = 0;
    int too_near = 0;
    double worst_m = 0;                   // by how much at most
    std::array<double, 3> worst_place{};  // in voxels
    // Against the exact signed distance within the range, over the width of the range.
    ErrorFigures texel;
    ErrorFigures lookup;
    std::array<double, 3> farthest_off{};  // the place of the largest error of a lookup
    std::int64_t steps = 0;                // of `rays` rays that are traced in spheres
    std::int64_t lost_steps = 0;           // steps that end in the cloud
    int rays = 0;

    bool failed() const { return too_far + too_near > 0 || lost_steps > 0; }
};

// Takes the first `points` points of Roberts' sequence (low_discrepancy_point), the texels that they
// lie in, and rays from the first `rays` of them. Lookups are made as GPUs make them, with weights
// rounded to 1/256. Returns what was found until options.progress was cancelled.
DistanceCheckResult check_distances(const DistanceTexture& texture, const DistanceCode& code,
                                    const NearestVoxel& nearest, const std::array<int, 3>& voxels,
                                    const std::array<double, 3>& voxel_m, int points, int rays,
                                    const BakeOptions& options);

}  // namespace skybake::occupancy
