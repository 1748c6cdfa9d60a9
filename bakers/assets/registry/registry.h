// The bakers of all assets, for code that works with any of them: planning, baking, reports,
// pictures.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/assets/registry/baker.h"
#include "config/recipe/recipe.h"

namespace skybake {

// The baker of one asset. Its functions accept bakes of that asset only.
struct AnyBaker {
    std::string_view asset;  // "transmittance"
    int version = 0;
    std::vector<VariantKey> variants;
    std::function<std::vector<InputFile>(const Parameters&, const Bake&)> inputs;
    std::function<Estimate(const Parameters&, const Bake&)> estimate;
    std::function<std::vector<Need>(const Parameters&, const Bake&, Certification)> needs;
    std::function<AssetPlaces(const Parameters&, const Bake&, const StoredTexels&)> places;
    std::function<AssetLookup(const Parameters&, const Bake&, const StoredTexels&)> lookup;
    std::function<std::optional<TracedLight>(const Parameters&, const Bake&)> traced;
    std::function<void(Bake&, int most_voxels)> draft;
    std::function<Outcome<Baked>(const Parameters&, const Bake&, const BakeOptions&, AssetLabel)>
        bake;
};

// Returns the bakers in the order of config/assets/assets.h.
std::span<const AnyBaker> bakers();

// Returns the baker of a [bake.NAME] section.
const AnyBaker& baker_of(const Bake& bake);

// Returns what the bakes are made from and share.
std::vector<Need> needs_of(const Parameters& parameters, std::span<const Bake> bakes,
                           Certification certification);

// Returns the resolved parameters on which an asset depends, as TOML. Its files carry them.
std::string asset_parameters(const Recipe& recipe, const Bake& bake);

// Returns where a value stands in the recipe's files, or no place for a default or a preset's value.
config::SourceRange recipe_place(const config::ResolvedValue& value);

// Gives a diagnostic of a baker its place in the recipe: the line of its key, else the first line of the
// asset's section.
void add_recipe_place(const Recipe& recipe, const Bake& bake, Diagnostic& diagnostic);

// Returns E0405 for each asset that check_solvable refuses, with its place in the recipe.
std::vector<Diagnostic> check_air(const Recipe& recipe);

// Bakes one section of a recipe. Unless certification is off, light that is scattered more than once
// is compared with paths of light. E0405 if it needs light that cannot be solved for
// (sky_asset.h). W0214 and W0220 to W0222 if it is measured and far off (certificate_warnings.h).
// Diagnostics have their places in the recipe.
Outcome<Baked> bake_asset(const Recipe& recipe, const Bake& bake, const BakeOptions& options);

}  // namespace skybake
