// Which baker makes which asset: one table for planning, baking and metadata.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "bakers/assets/estimate.h"
#include "bakers/field/baked_table.h"
#include "bakers/field/volume.h"
#include "bakers/math/bake_options.h"
#include "config/diagnostics/diagnostic.h"
#include "config/recipe/recipe.h"

namespace skybake {

// A table holds its texels, a volume can make its voxels.
using BakedAsset = std::variant<BakedTable, BakedVolume>;

// What files say of an asset whatever it is.
struct AssetLabel {
    std::string name;
    std::string parameters;  // TOML
    Facts details;
};

// A file besides the recipe that an asset is made from.
struct InputFile {
    std::string name;  // as the recipe has it
    std::filesystem::path path;
};

struct Baker {
    std::string_view asset;  // "transmittance"
    int version = 0;         // raised when its bytes change for equal parameters
    // Patterns of the parameters that an asset depends on, besides those of its own section.
    std::vector<std::string> (*parameters)(const config::Parameters& parameters,
                                           const config::Bake& bake);
    std::vector<InputFile> (*inputs)(const config::Parameters& parameters,
                                     const config::Bake& bake);
    Estimate (*estimate)(const config::Parameters& parameters, const config::Bake& bake);
    // `label` has what all assets say of themselves: name, parameters, details.
    config::Outcome<BakedAsset> (*bake)(const config::Parameters& parameters,
                                        const config::Bake& bake, const BakeOptions& options,
                                        AssetLabel label);
};

std::span<const Baker> bakers();

// The baker of a [bake.NAME] section.
const Baker& baker_of(const config::Bake& bake);

// The resolved parameters that an asset depends on, as TOML: what its files carry.
std::string asset_parameters(const config::Recipe& recipe, const config::Bake& bake);

// Bakes one section of a recipe.
config::Outcome<BakedAsset> bake_asset(const config::Recipe& recipe, const config::Bake& bake,
                                       const BakeOptions& options);

// The same of a section that asks for a table, and only of such a one.
config::Outcome<BakedTable> bake_table(const config::Recipe& recipe, const config::Bake& bake,
                                       const BakeOptions& options);

}  // namespace skybake
