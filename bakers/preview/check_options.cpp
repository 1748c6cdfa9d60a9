#include "bakers/preview/check_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string_view>
#include <utility>

#include "bakers/assets/registry/registry.h"
#include "bakers/render/sun_position.h"
#include "config/recipe/preview_section.h"
#include "config/text/text.h"

namespace skybake {
namespace {

double to_degrees(double radians) { return radians * 180 / std::numbers::pi; }

std::optional<double> to_degrees(const std::optional<double>& radians) {
    return radians ? std::optional(to_degrees(*radians)) : std::nullopt;
}

template <class T>
void take(std::optional<T>& option, const std::optional<T>& of_recipe) {
    if (!option) option = of_recipe;
}

void take_camera(const config::PreviewCamera& camera, PreviewOptions& options) {
    if (!options.camera) options.camera.emplace();
    CameraRequest& request = *options.camera;
    // A single tile that the command line asks for is framed anew.
    if (!options.single) take(request.position_m, camera.position);
    take(request.heading_degrees, to_degrees(camera.heading));
    take(request.pitch_degrees, to_degrees(camera.pitch));
    take(request.field_degrees, to_degrees(camera.fov));
}

std::string place_text(const EarthPlace& place) {
    return fmt::format("{:g} degrees {}, {:g} degrees {}", std::fabs(place.latitude_degrees),
                       place.latitude_degrees < 0 ? "south" : "north",
                       std::fabs(place.longitude_degrees),
                       place.longitude_degrees < 0 ? "west" : "east");
}

// Places the sun at the time. The position is as exact as its third digit.
void place_sun(bool clouds, PreviewOptions& options) {
    const auto hundredths = [](double angle) { return std::round(100 * angle) / 100; };
    const double utc = config::utc_seconds(*options.at, options.place->longitude_degrees);
    const SunPosition sun = sun_position(utc, *options.place);
    options.sun_elevations_deg = {hundredths(sun.elevation_degrees)};
    if (clouds) options.sun_azimuth_deg = hundredths(90 - sun.azimuth_degrees);
    options.note = fmt::format(
        "At {}, {}, the sun stands at an elevation of {:.2f} degrees, without refraction, and an "
        "azimuth of {:.1f} degrees from north towards east; +y is north and +x is east.",
        config::utc_text(utc), place_text(*options.place), sun.elevation_degrees,
        sun.azimuth_degrees);
    options.at.reset();
    options.place.reset();
}

// Takes what places the sun. What the command line says about the sun, by a time or by angles,
// replaces what the recipe says in the other way; the azimuth of its time stays where elevations alone are given.
void take_sun(const config::Preview& preview, bool clouds, PreviewOptions& options) {
    const bool by_angles = !options.sun_elevations_deg.empty() || options.sun_azimuth_deg;
    const bool by_time = options.at.has_value();
    if (preview.latitude && preview.longitude && !options.place && !by_angles) {
        options.place = {to_degrees(*preview.latitude), to_degrees(*preview.longitude)};
    }
    if (preview.at && !by_angles && !by_time) options.at = config::parse_moment(*preview.at);
    if (options.at) return;
    if (preview.at && preview.latitude && preview.longitude && clouds && !options.sun_azimuth_deg) {
        PreviewOptions timed;  // a sun that is lower or higher stands where it does then
        timed.at = config::parse_moment(*preview.at);
        timed.place = {to_degrees(*preview.latitude), to_degrees(*preview.longitude)};
        place_sun(true, timed);
        options.sun_azimuth_deg = timed.sun_azimuth_deg;
    }
    if (options.sun_elevations_deg.empty()) {
        for (const config::Angle elevation : preview.sun_elevation) {
            options.sun_elevations_deg.push_back(to_degrees(elevation.radians));
        }
    }
    if (clouds) take(options.sun_azimuth_deg, to_degrees(preview.sun_azimuth));
}

void take_section(const config::Preview& preview, const LitPictures& lit, PreviewOptions& options) {
    if (lit.sky) {
        take(options.altitude_m, preview.altitude);
        take(options.glare, std::optional(preview.glare));
    }
    if (lit.clouds) {
        take_camera(preview.camera, options);
        if (!lit.sweep) take(options.picture_size, preview.size);
        options.single = options.single || preview.single;
    }
    if (!lit.sky && !lit.clouds) return;
    take(options.exposure_stops, preview.exposure);
    take(options.tone_curve, std::optional(preview.tone_curve));
    take_sun(preview, lit.clouds, options);
}

struct GivenOption {
    std::string_view name;  // with `_`, as the key of [preview] that is like it
    bool given = false;
};

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

Outcome<PreviewOptions> completed(PreviewOptions options, const Recipe* recipe,
                                  const LitPictures& lit) {
    const bool by_angles = !options.sun_elevations_deg.empty() || options.sun_azimuth_deg;
    if (options.at && by_angles) {
        return diagnosis("E0001", "--at excludes --sun-elevation and --sun-azimuth",
                         "the time and the place say where the sun stands");
    }
    const bool place_is_asked = options.place.has_value();
    if (recipe != nullptr && recipe->preview) take_section(*recipe->preview, lit, options);
    if (options.at && !options.place) {
        return diagnosis("E0001", "--at needs a place",
                         "give --place 47.4,8.5, or latitude and longitude in [preview]");
    }
    if (place_is_asked && !options.at) {
        return diagnosis("E0001", "--place needs a time", "give --at \"2026-06-21 18:30\"");
    }
    if (options.at) place_sun(lit.clouds, options);
    return {std::move(options), {}};
}

LitPictures lit_pictures_of(std::span<const Bake> bakes) {
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

std::vector<Diagnostic> unused_options(const LitPictures& lit, const PreviewOptions& options) {
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
    std::vector<Diagnostic> problems;
    for (const GivenOption& option : all) {
        const std::string_view reason = config::why_unused(option.name, pictures);
        if (!option.given || reason.empty()) continue;
        const std::string name = config::replaced(option.name, {{'_', "-"}});
        problems.push_back(diagnosis("E0001",
                                     fmt::format("no picture of this preview uses --{}", name),
                                     std::string(reason)));
    }
    return problems;
}

std::vector<Diagnostic> unused_keys(const Recipe& recipe) {
    std::vector<Diagnostic> warnings;
    if (recipe.parameters.bakes.empty()) return warnings;
    const config::PicturesOfLight pictures = config::pictures_of_light(recipe.parameters.bakes);
    for (const config::ResolvedValue& value : recipe.values) {
        const bool is_camera = value.section == "preview.camera";
        if (value.section != "preview" && !is_camera) continue;
        const std::string key = is_camera ? "camera" : value.path.substr(value.section.size() + 1);
        const std::string_view reason = config::why_unused(key, pictures);
        if (reason.empty() || value.origin.starts_with("preset ")) continue;
        warnings.push_back({Severity::warning, "W0216",
                            fmt::format("no picture of this recipe uses `{}`", value.path),
                            recipe_place(value), std::string(reason)});
    }
    return warnings;
}

std::optional<Diagnostic> camera_above_air(const PreviewAssets& assets,
                                           const PreviewOptions& options) {
    const LitPictures lit = lit_pictures_of(assets);
    double altitude_m = lit.sky ? options.altitude_m.value_or(0) : 0;
    if (lit.clouds && options.camera && options.camera->position_m) {
        altitude_m = std::max(altitude_m, options.camera->position_m->at(2));
    }
    double top_m = 100e3;  // of the preset `earth`
    if (const Recipe* air =
            lit.sky ? &*assets.recipe : stated_air(assets.recipe ? &*assets.recipe : nullptr)) {
        const config::Atmosphere& atmosphere = air->parameters.atmosphere;
        top_m = atmosphere.top_radius.meters - atmosphere.ground_radius.meters;
    }
    if (altitude_m <= top_m) return std::nullopt;
    return diagnosis(
        "E0110",
        fmt::format(
            "the altitude of the camera, {:g} km, is above the top of the atmosphere, {:g} km",
            altitude_m / 1000, top_m / 1000));
}

std::vector<Diagnostic> clouds_cut_by_tile(const PreviewAssets& assets,
                                           const PreviewOptions& options) {
    std::vector<Diagnostic> warnings;
    if (!options.single) return warnings;
    for (const PreviewAsset& asset : assets.assets) {
        if (asset.entry.kind != "cloud_volume" || asset.voxels.empty()) continue;
        if (!reaches_sides(asset)) continue;
        warnings.push_back(diagnosis(
            "W0218",
            fmt::format(
                "`{}` reaches the sides of its tile: a picture of a single one shows walls there",
                asset.entry.name),
            "show the layer, or give the cloud a larger extent"));
    }
    return warnings;
}

Recipe draft_of(Recipe recipe, int most_voxels) {
    for (Bake& bake : recipe.parameters.bakes) baker_of(bake).draft(bake, most_voxels);
    return recipe;
}

}  // namespace skybake
