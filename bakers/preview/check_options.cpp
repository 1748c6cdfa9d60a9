#include "bakers/preview/check_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <utility>

#include "bakers/assets/registry/registry.h"
#include "config/recipe/preview_section.h"

namespace skybake {
namespace {

struct GivenOption {
    std::string_view name;  // with `_`, as the key of [preview] that is like it
    bool given = false;
};

config::Diagnostic unused_option(std::string name, std::string_view reason) {
    std::ranges::replace(name, '_', '-');
    return option_fault(fmt::format("no picture of this preview uses --{}", name),
                        std::string(reason));
}

// Whether a voxel at the tile's sides has at least a twentieth of the greatest density.
bool reaches_sides(const PreviewAsset& volume) {
    const int width = volume.entry.size[0];
    const int rows = volume.entry.size[1];
    const int depth = volume.entry.size[2];
    const std::size_t channels = volume.entry.channels.size();
    const double greatest = volume.entry.levels.front().statistics.front().max;
    const auto is_cloud = [&](int x, int y, int z) {
        const std::size_t at = (static_cast<std::size_t>(z) * static_cast<std::size_t>(rows) +
                                static_cast<std::size_t>(y)) *
                                   static_cast<std::size_t>(width) +
                               static_cast<std::size_t>(x);
        return greatest > 0 && double{volume.voxels[at * channels]} >= greatest / 20;
    };
    for (int z = 0; z < depth; ++z) {
        for (int x = 0; x < width; ++x) {
            if (is_cloud(x, 0, z) || is_cloud(x, rows - 1, z)) return true;
        }
        for (int y = 0; y < rows; ++y) {
            if (is_cloud(0, y, z) || is_cloud(width - 1, y, z)) return true;
        }
    }
    return false;
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

std::vector<config::Diagnostic> unused_keys(const config::Recipe& recipe) {
    std::vector<config::Diagnostic> warnings;
    if (recipe.parameters.bakes.empty()) return warnings;
    const config::PicturesOfLight pictures = config::pictures_of_light(recipe.parameters.bakes);
    for (const config::ResolvedValue& value : recipe.values) {
        const bool is_camera = value.section == "preview.camera";
        if (value.section != "preview" && !is_camera) continue;
        const std::string key = is_camera ? "camera" : value.path.substr(value.section.size() + 1);
        const std::string_view reason = config::why_unused(key, pictures);
        if (reason.empty() || value.origin.starts_with("preset ")) continue;
        config::Diagnostic warning;
        warning.severity = config::Severity::warning;
        warning.code = "W0216";
        warning.message = fmt::format("no picture of this recipe uses `{}`", value.path);
        warning.label = reason;
        warning.where = recipe_place(value);
        warnings.push_back(std::move(warning));
    }
    return warnings;
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

std::vector<config::Diagnostic> clouds_cut_by_tile(const PreviewAssets& assets,
                                                   const PreviewOptions& options) {
    std::vector<config::Diagnostic> warnings;
    if (!options.single) return warnings;
    for (const PreviewAsset& asset : assets.assets) {
        if (asset.entry.kind != "cloud_volume" || asset.voxels.empty()) continue;
        if (!reaches_sides(asset)) continue;
        config::Diagnostic warning;
        warning.severity = config::Severity::warning;
        warning.code = "W0218";
        warning.message = fmt::format(
            "`{}` reaches the sides of its tile: a picture of a single one shows walls there",
            asset.entry.name);
        warning.label = "show the layer, or give the cloud a larger extent";
        warnings.push_back(std::move(warning));
    }
    return warnings;
}

config::Recipe draft_of(config::Recipe recipe, int most_voxels) {
    for (config::Bake& bake : recipe.parameters.bakes) baker_of(bake).draft(bake, most_voxels);
    return recipe;
}

}  // namespace skybake
