#include "bakers/preview/check_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <variant>

#include "bakers/assets/registry.h"
#include "config/assets/cloud_volume.h"
#include "config/assets/multiple_scattering.h"
#include "config/assets/transmittance.h"

namespace skybake {
namespace {

template <class Section>
bool has_section(std::span<const config::Bake> bakes) {
    return std::any_of(bakes.begin(), bakes.end(),
                       [](const config::Bake& bake) { return bake.is<Section>(); });
}

// An option, whether it was given, and whether a picture uses it.
struct OptionUse {
    std::string_view name;
    bool given = false;
    bool used = false;
    std::string_view what;  // names the pictures that use it
};

}  // namespace

LitPictures lit_pictures_of(std::span<const config::Bake> bakes) {
    LitPictures lit;
    lit.sky = has_section<config::TransmittanceBake>(bakes) &&
              has_section<config::MultipleScatteringBake>(bakes);
    lit.clouds = has_section<config::CloudVolumeBake>(bakes);
    return lit;
}

LitPictures lit_pictures_of(const PreviewAssets& assets) {
    LitPictures lit;
    if (!assets.recipe) return lit;
    lit.sky = assets.of_kind("transmittance") != nullptr &&
              assets.of_kind("multiple_scattering") != nullptr;
    lit.clouds = assets.of_kind("cloud_volume") != nullptr;
    return lit;
}

std::vector<config::Diagnostic> unused_options(const LitPictures& lit,
                                               const PreviewOptions& options) {
    if (options.live) return {};  // a live page uses all that it can be asked for
    const bool sky = lit.sky && !(lit.sweep && lit.clouds);
    const bool any = sky || lit.clouds;
    constexpr std::string_view light = "only pictures of a sky or of a lit cloud use it";
    constexpr std::string_view clouds =
        "only pictures of a lit cloud use it, which need a [bake.*] cloud_volume";
    constexpr std::string_view skies =
        "only pictures of a sky use it, which need a transmittance and a multiple_scattering table";
    const OptionUse uses[] = {
        {"sun-elevation", !options.sun_elevations_deg.empty(), any, light},
        {"exposure", options.exposure_stops.has_value(), any, light},
        {"tone-curve", options.tone_curve.has_value(), any, light},
        {"altitude", options.altitude_m.has_value(), sky,
         lit.clouds ? "only pictures of a sky use it; --camera places the camera of a cloud"
                    : skies},
        {"glare", options.glare.has_value(), sky, skies},
        {"sun-azimuth", options.sun_azimuth_deg.has_value(), lit.clouds, clouds},
        {"camera", options.camera.has_value(), lit.clouds, clouds},
        {"size", options.picture_size.has_value(), lit.clouds || lit.sweep, clouds},
        {"single", options.single, lit.clouds, clouds},
    };
    std::vector<config::Diagnostic> problems;
    for (const OptionUse& use : uses) {
        if (!use.given || use.used) continue;
        config::Diagnostic problem;
        problem.code = "E0001";
        problem.message = fmt::format("no picture of this preview uses --{}", use.name);
        problem.label = use.what;
        problems.push_back(std::move(problem));
    }
    return problems;
}

std::optional<config::Diagnostic> camera_above_air(const PreviewAssets& assets,
                                                   const PreviewOptions& options) {
    if (!options.altitude_m || !assets.recipe || assets.of_kind("transmittance") == nullptr ||
        assets.of_kind("multiple_scattering") == nullptr) {
        return std::nullopt;
    }
    const config::Atmosphere& atmosphere = assets.recipe->parameters.atmosphere;
    const double top_m = atmosphere.top_radius.meters - atmosphere.ground_radius.meters;
    if (*options.altitude_m <= top_m) return std::nullopt;
    config::Diagnostic diagnostic;
    diagnostic.code = "E0110";
    diagnostic.message =
        fmt::format("--altitude: {:g} km is above the top of the atmosphere, {:g} km",
                    *options.altitude_m / 1000, top_m / 1000);
    return diagnostic;
}

config::Recipe draft_of(config::Recipe recipe, int most_voxels) {
    for (config::Bake& bake : recipe.parameters.bakes) baker_of(bake).draft(bake, most_voxels);
    return recipe;
}

}  // namespace skybake
