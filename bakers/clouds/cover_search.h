// Finds the coverage that gives a cloud a wanted cover: the share of its columns of voxels that hold
// cloud as they are stored.
//
// A voxel is cloud if its v (cloud_plan.h) is above the least value u that is stored as cloud. In real
// numbers, with b = x + c m - 1, x = n max(0, P + T + S), and m the coverage map's value or 1, that is
//
//   q + c m - 1 > 0,   q = x - e - u (1 - e)
//
// so that one pass over all voxels at c = 1 gives each column the greatest q, and the coverage c from
// which on it holds cloud. The pass is made with float kernels; columns that a rounding of theirs may
// decide are asked for their voxels at that very coverage.
#pragma once

#include <array>
#include <cstddef>
#include <functional>

#include "bakers/clouds/cloud_plan.h"
#include "bakers/math/bake_options.h"
#include "config/sections/pixel_types.h"

namespace skybake::cloud {

struct CoverRequest {
    double share = 0;  // of the columns, in [0, 1]
    float level = 0;   // stored values above this are cloud
    PixelType pixel_type = PixelType::float32;
};

struct FoundCover {
    double coverage = 1;
    double share = 0;               // of the columns that hold cloud at this coverage
    std::array<double, 2> tried{0, 1};  // the least and the greatest coverage of the search
    std::array<double, 2> reach{};      // the shares at these
};

// One in so many columns, or 512, may hold cloud from the same coverage on. Where the noise is constant, more
// do, and the search ends at that coverage.
inline constexpr std::size_t kMostTiedColumns = 255;

// Bisects the coverage in [0, 1], to which the count of columns rises, until it is the nearest whole
// number to the wanted share of all columns. Where columns fill together and none has that count, the
// nearest one is found. The plan's own coverage does not matter. The result is the same for any
// number of threads and any instruction set. After an interruption it must not be used.
FoundCover find_cover(const CloudPlan& plan, const CoverRequest& request,
                      const BakeOptions& options);

// Finds the same for a cloud that has grown, whose coverage may be any number (grown_volume.h), by counting the
// columns of the plans of that size that `plan_of` makes of coverages.
FoundCover find_grown_cover(const std::function<CloudPlan(double coverage)>& plan_of,
                            const std::array<int, 3>& size, const CoverRequest& request,
                            const BakeOptions& options);

}  // namespace skybake::cloud
