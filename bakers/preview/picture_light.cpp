#include "bakers/preview/picture_light.h"

#include <fmt/format.h>

#include <iterator>
#include <utility>

#include "bakers/assets/description/probe_places.h"
#include "bakers/assets/registry/registry.h"

namespace skybake {
namespace {

// They are the tables of the preset `earth`, from light that skies share.
constexpr const char* kTables =
    "[bake.transmittance]\nsize = [256, 64]\n[bake.multiple_scattering]\ncontent = \"moments\"\n";

// Skies of a few cameras and suns take some MiB. Beyond this many assets the memo is emptied.
constexpr std::size_t kMostAssets = 64;

bool is_of_sections(const config::ResolvedValue& value) {
    return value.path.starts_with("bake.") || value.path.starts_with("color.");
}

// Returns the recipe of the sections, in the air of another one. Light stays spectral, as pictures mix it.
Outcome<Recipe> recipe_of(const Recipe* air, const std::string& sections) {
    auto own =
        config::parse_recipe("preset = \"earth\"\n[color]\nspace = \"none\"\n" + sections, "earth");
    if (air == nullptr || !own.value) return own;
    Recipe recipe = *air;
    recipe.parameters.bakes = std::move(own.value->parameters.bakes);
    recipe.parameters.color = own.value->parameters.color;
    std::erase_if(recipe.values, is_of_sections);
    std::ranges::copy_if(own.value->values, std::back_inserter(recipe.values), is_of_sections);
    return {std::move(recipe), {}};
}

}  // namespace

const Recipe* stated_air(const Recipe* recipe) {
    if (recipe == nullptr || !(recipe->parameters.atmosphere.top_radius.meters > 0)) return nullptr;
    const std::size_t wavelengths = recipe->parameters.wavelengths.size();
    return wavelengths == 3 || wavelengths == 4 ? recipe : nullptr;
}

PictureLight::PictureLight(Intermediates* intermediates, AssetMemo files)
    : own_(BakeOptions().held_voxel_bytes),
      intermediates_(intermediates != nullptr ? *intermediates : own_),
      memo_(std::move(files)) {
    memo_.keeps_all = true;
}

Outcome<PreviewAssets> PictureLight::bake(const Recipe* air, const std::string& sections,
                                          BakeOptions options) {
    auto recipe = recipe_of(air, sections);
    if (!recipe.value) return {{}, std::move(recipe.diagnostics)};
    const Parameters& parameters = recipe.value->parameters;
    options.certification = Certification::off;
    options.intermediates = &intermediates_;
    expected_[air == nullptr ? 0 : 1] =
        intermediates_.expect(needs_of(parameters, parameters.bakes, options.certification));
    if (memo_.assets.size() > kMostAssets) memo_.assets.clear();
    return bake_assets(*recipe.value, parameters.bakes, "light", options, &memo_);
}

Outcome<PreviewAssets> PictureLight::tables(const Recipe* air, const BakeOptions& options) {
    return bake(air, kTables, options);
}

std::optional<SolvedSky> PictureLight::sky(const Recipe* air, const SolvedSky::Place& place,
                                           const BakeOptions& options) {
    const std::string section = fmt::format(
        "[bake.sky_view]\nsize = [256, 192]\naltitude = \"{} km\"\n"
        "sun_elevations = [\"{} deg\"]\n",
        place.altitude_km, place.sun_elevation_degrees);
    const auto baked = bake(air, section, options);
    if (!baked.value) return std::nullopt;
    const Shell shell = shell_of(baked.value->recipe->parameters.atmosphere);
    return SolvedSky::of(baked.value->assets.front(), shell, place);
}

}  // namespace skybake
