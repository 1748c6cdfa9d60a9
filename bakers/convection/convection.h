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

struct GrownCloud {
    std::array<int, 3> cells{};
    // Condensed water at the centres of cells in g/kg, x fastest, then y, then z; below 0 it is what the air
    // lacks to be saturated, so that edges lie where it passes 0. The lowest cells lie on the base.
    std::vector<float> water;
    float full_water = 0;  // Sounding::adiabatic_water
};

// Returns what the growth of a cloud with shape = "convection" depends on.
Specification specification_of(const Cloud& cloud);

// Grows the cloud, unless `kept` has it from an earlier run. Returns null after an interruption.
std::shared_ptr<const GrownCloud> grow(const Specification& wanted, const BakeOptions& options,
                                       KeptBytes* kept = nullptr);

// Raise it with every change of what grows.
constexpr int kGrowthVersion = 1;

// Rough figures: the seconds on one thread of a machine of 2022, and the bytes while it grows.
double seconds_to_grow(const Specification& wanted);
double bytes_to_grow(const Specification& wanted);

}  // namespace skybake::convection
