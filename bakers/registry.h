// Which baker makes which asset: one table for planning, baking and metadata.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/core/bake_options.h"
#include "bakers/core/baked_table.h"
#include "config/diagnostic.h"
#include "config/recipe.h"

namespace skybake {

// What a bake will take, before it is made. Rough: for people and for limits, not for results.
struct Estimate {
    std::array<int, 2> size{};  // 0 x 0 where max_error will choose it
    double seconds = 0;         // on one thread of a machine of 2022
    double memory_mib = 0;
    double disk_mib = 0;
};

struct Baker {
    std::string_view asset;                    // "transmittance"
    int version = 0;                           // raised when its bytes change for equal parameters
    std::vector<std::string_view> parameters;  // patterns of the parameters that it depends on
    Estimate (*estimate)(const config::Bake& bake);
    config::Outcome<BakedTable> (*bake)(const config::Parameters& parameters,
                                        const config::Bake& bake, const BakeOptions& options,
                                        BakedTable table);
};

std::span<const Baker> bakers();

// The baker of a [bake.NAME] section.
const Baker& baker_of(const config::Bake& bake);

// Bakes one section of a recipe.
config::Outcome<BakedTable> bake_table(const config::Recipe& recipe, const config::Bake& bake,
                                       const BakeOptions& options);

}  // namespace skybake
