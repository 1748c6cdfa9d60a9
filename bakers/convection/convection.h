// A cloud that has grown by moist convection.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "bakers/convection/sounding.h"
#include "bakers/math/bake_options.h"
#include "bakers/math/intermediates.h"
#include "config/sections/cloud.h"

namespace skybake::convection {

// The loop of a cloud that moves goes from the state S at the end of its growth, g, for l seconds. In its course the
// state of a loop before takes over, so that the last frame leads to the first one:
//
//   (1 - w) S(g + f l) + w S(g + f l - l),   w = f^2 (3 - 2 f)
//
// at the share f of the loop. Warm patches begin anew whenever so much time as the growth took has passed.
struct GrownCloud {
    std::array<int, 3> cells{};
    int moments = 1;  // of the loop, evenly; of a cloud that stands still there is one
    // Condensed water at the centres of cells in g/kg, x fastest, then y, then z; below 0 it is what the air
    // lacks to be saturated, so that edges lie where it passes 0. The lowest cells lie on the base. One moment
    // follows the other.
    std::vector<float> water;
    // The velocity there in m/s, less that of the tile: of each moment along x, then y, then z; or none.
    std::vector<float> velocity;
    float full_water = 0;  // Sounding::adiabatic_water
};

// Returns what the growth of a cloud with shape = "convection" depends on.
Specification specification_of(const Cloud& cloud);

// Grows the cloud, unless `kept` has it from an earlier run. Returns null after an interruption.
std::shared_ptr<const GrownCloud> grow(const Specification& wanted, const BakeOptions& options,
                                       KeptBytes* kept = nullptr);

// Returns the cloud at a share of its loop; between moments its water is linear in time.
std::shared_ptr<const GrownCloud> at_share(const std::shared_ptr<const GrownCloud>& cloud,
                                           double share);

// Raise it with every change of what grows.
constexpr int kGrowthVersion = 2;

// Rough figures: the seconds on one thread of a machine of 2022, and the bytes while it grows.
double seconds_to_grow(const Specification& wanted);
double bytes_to_grow(const Specification& wanted);
double bytes_of_grown(const Specification& wanted);

}  // namespace skybake::convection
