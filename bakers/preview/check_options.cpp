#include "bakers/preview/check_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

#include "bakers/assets/registry.h"
#include "config/recipe/preview_section.h"

namespace skybake {
namespace {

struct GivenOption {
    std::string_view name;  // with `_`, as the key of [preview] that is like it
    bool given = false;
};

config::Diagnostic unused_option(std::string name, std::string_view reason) {
    std::replace(name.begin(), name.end(), '_', '-');
    return option_fault(fmt::format("no picture of this preview uses --{}", name),
                        std::string(reason));
}

}  // namespace

config::Diagnostic option_fault(std::string message, std::string label) {
    config::Diagnostic diagnostic;
    diagnostic.code = "E0001";
    diagnostic.message = std::move(message);
    diagnostic.label = std::move(label);
    return diagnostic;
}

LitPictures lit_pictures_of(std::span<const config::Bake> bakes) {
    const config::PicturesOfLight light = config::pictures_of_light(bakes);
    return {light.sky, light.clouds, false};
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
    const GivenOption all[] = {
        {"sun_elevation", !options.sun_elevations_deg.empty()},
        {"sun_azimuth", options.sun_azimuth_deg.has_value()},
        {"at", options.at.has_value()},
        {"place", options.place.has_value()},
        {"exposure", options.exposure_stops.has_value()},
        {"tone_curve", options.tone_curve.has_value()},
        {"glare", options.glare.has_value()},
        {"altitude", options.altitude_m.has_value()},
        {"camera", options.camera.has_value()},
        {"size", options.picture_size.has_value() && !lit.sweep},
        {"single", options.single},
        {"turntable", options.turntable > 0},
    };
    const config::PicturesOfLight pictures = {lit.sky && !(lit.sweep && lit.clouds), lit.clouds};
    std::vector<config::Diagnostic> problems;
    for (const GivenOption& option : all) {
        const std::string_view reason = config::why_unused(option.name, pictures);
        if (option.given && !reason.empty()) {
            problems.push_back(unused_option(std::string(option.name), reason));
        }
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
    diagnostic.message = fmt::format(
        "the altitude of the camera, {:g} km, is above the top of the atmosphere, {:g} km",
        *options.altitude_m / 1000, top_m / 1000);
    return diagnostic;
}

config::Recipe draft_of(config::Recipe recipe, int most_voxels) {
    for (config::Bake& bake : recipe.parameters.bakes) baker_of(bake).draft(bake, most_voxels);
    return recipe;
}

}  // namespace skybake
