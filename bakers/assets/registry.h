// The bakers of all assets, for those who need not know which: planning, baking, reports, pictures.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/assets/baker.h"
#include "config/recipe/recipe.h"

namespace skybake {

// Baker of some asset; its functions take bakes of that asset alone.
struct AnyBaker {
    std::string_view asset;  // "transmittance"
    int version = 0;
    std::function<std::vector<InputFile>(const config::Parameters&, const config::Bake&)> inputs;
    std::function<Estimate(const config::Parameters&, const config::Bake&)> estimate;
    std::function<AssetPlaces(const config::Parameters&, const config::Bake&, const StoredTexels&)>
        places;
    std::function<AssetLookup(const config::Parameters&, const config::Bake&, const StoredTexels&)>
        lookup;
    std::function<void(config::Bake&, int most_voxels)> draft;
    std::function<config::Outcome<Baked>(const config::Parameters&, const config::Bake&,
                                         const BakeOptions&, AssetLabel)>
        bake;
};

// In the order of config/assets/assets.h.
std::span<const AnyBaker> bakers();

// The baker of a [bake.NAME] section.
const AnyBaker& baker_of(const config::Bake& bake);

// The resolved parameters that an asset depends on, as TOML: what its files carry.
std::string asset_parameters(const config::Recipe& recipe, const config::Bake& bake);

// Bakes one section of a recipe.
config::Outcome<Baked> bake_asset(const config::Recipe& recipe, const config::Bake& bake,
                                  const BakeOptions& options);

}  // namespace skybake
