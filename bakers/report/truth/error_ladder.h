// The ladder of errors: what lies between a recipe's tables and the clear sky that people see, step
// by step, each with its size.
//
//   colour         colours made of the recipe's wavelengths against those of whole spectra
//   air            the air's coefficients against measured ones
//   profile        the Earth's light at dusk, with its air and ozone where they are against where the
//                  US Standard Atmosphere has them
//   polarisation   light without polarisation against light with it: a published estimate
//   closure        light of all orders, as it is solved for, against traced paths
//   table          what a runtime makes of the recipe's table of multiple scattering, against traced
//                  paths
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bakers/math/bake_options.h"
#include "config/sections/parameters.h"

namespace skybake {

struct LadderSize {
    double typical = 0;  // a median or mean, as a share
    double high = 0;     // what nine in ten are below, or the largest of a few
};

struct LadderStep {
    std::string name;
    std::optional<LadderSize> size;  // none: it cannot be told
    std::string sentence;            // what it is
};

// The error of a method of the report, by its key (sky_methods.h).
using MethodErrors = std::vector<std::pair<std::string, LadderSize>>;

// Returns the six steps. The recipe must have an atmosphere; `methods` are in the order of
// sky_methods. After an interruption the result must not be used.
std::vector<LadderStep> error_ladder(const config::Parameters& parameters,
                                     const MethodErrors& methods, const BakeOptions& options);

}  // namespace skybake
