#include "bakers/preview/live/live_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "bakers/march/cloud_light.h"
#include "bakers/preview/check_options.h"
#include "bakers/preview/cloud_inputs.h"
#include "bakers/preview/live/live_glsl.h"
#include "bakers/preview/pictures/asset_pictures.h"
#include "bakers/preview/pictures/cloud_lighting.h"
#include "bakers/preview/runtime/runtime_library.h"
#include "bakers/render/cloud_view.h"
#include "bakers/render/tone_curve.h"
#include "config/recipe/recipe.h"
#include "config/text/mapped.h"

namespace skybake {
namespace {

using Json = LiveJson;

// --- Clouds --------------------------------------------------------------------------------------

std::vector<CloudPreviewInput> shown_inputs(const PreviewAssets& assets,
                                            const PreviewOptions& options) {
    std::vector<CloudPreviewInput> inputs = scene_input(assets, options);
    std::erase_if(inputs, [](const auto& input) { return !has_all_texels(*input.volume); });
    if (options.single && inputs.size() > 1) inputs.resize(1);
    return inputs;
}

// Returns the first voxel that each copy reads, along x and y (TileVariation).
Json shift_texture(const std::vector<LiveCloud>& clouds) {
    Image2<float> shifts(kVariedTiles, kVariedTiles * static_cast<int>(clouds.size()), 2);
    std::size_t at = 0;
    for (const LiveCloud& cloud : clouds) {
        const TileVariation& variation = cloud.medium.variation;
        for (std::size_t i = 0; i < variation.shift_x.size(); ++i) {
            shifts.texels[at++] = variation.shift_x[i];
            shifts.texels[at++] = variation.shift_y[i];
        }
    }
    return table_texture("shift_table", "where copies of tiles begin", shifts);
}

Json cloud_json(const LiveCloud& cloud, const SceneLayer& layer, double greatest_error) {
    const CloudMedium& medium = cloud.medium;
    const CloudOptics& optics = medium.optics;
    return {{"name", cloud.volume->entry.name},
            {"leaps", cloud.leaps_name},
            {"greatest_error", greatest_error},
            {"tile", medium.extent_m},
            {"base", medium.base_m},
            {"extinction", optics.extinction_per_m},
            {"threshold", optics.has_edge ? Json(optics.threshold) : Json(nullptr)},
            {"edge_softness", optics.edge_softness},
            {"backward", backward_share(cloud_phase(optics.particles)) / 2},
            {"step", layer.step_m},
            {"voxel_edge", voxel_edge_m(medium)},
            {"most_sun_samples", kSunSamples},
            {"reach", medium.repeats ? usual_steps(medium, {}).reach_m : 1e6},
            {"farthest_reach", farthest_reach_m(medium)},
            {"end_slope", sine_of_degrees(kEndElevation)},
            {"fade_from", kFadeFrom},
            {"repeats", medium.repeats}};
}

// Returns the clouds that a page shows: those of the picture of one sky, whose tiles vary, or the only
// cloud, or the first one if a single tile is wanted.
std::vector<LiveCloud> live_clouds(const PreviewAssets& assets, const PreviewOptions& options) {
    const std::vector<CloudPreviewInput> inputs = shown_inputs(assets, options);
    std::vector<LiveCloud> clouds;
    for (const CloudPreviewInput& input : inputs) {
        const std::optional<Cloud> cloud = cloud_as_baked(input);
        LeapingMedium made = leaping_medium(input, *cloud, !options.single, options.threads);
        // The page can show the layer even where it first shows a single tile.
        if (options.single) made.medium.variation = varied_tiles(made.medium);
        clouds.push_back({input.volume, std::move(made.medium), std::move(made.leaps_name),
                          input.suns.front(), input.camera});
    }
    return clouds;
}

// Returns the steps and the reach of each cloud and the camera, as the pictures have them.
FramedScene framed_clouds(const std::vector<LiveCloud>& clouds, int width, int height) {
    const LiveCloud& first = clouds.front();
    std::vector<const CloudMedium*> media;
    for (const LiveCloud& cloud : clouds) media.push_back(&cloud.medium);
    return framed_scene(media, first.sun, width, height, first.camera);
}

// Describes the clouds for the page's own part of the march, and adds their textures.
Json clouds_json(const std::vector<LiveCloud>& clouds, const FramedScene& scene, Json& textures) {
    Json json = Json::array();
    for (std::size_t i = 0; i < clouds.size(); ++i) {
        const LiveCloud& cloud = clouds[i];
        const PreviewAsset& volume = *cloud.volume;
        const PackedVolume packed = packed_volume(volume);
        const LeapGrid& leaps = cloud.medium.leaps;
        json.push_back(cloud_json(cloud, scene.layers[i], packed.greatest_error));
        textures.push_back(texture(fmt::format("cloud_table_{}", i), volume.entry.name,
                                   volume.entry.size, 1, packed.type, packed.texels));
        textures.push_back(texture(fmt::format("cells_table_{}", i), cloud.leaps_name,
                                   {leaps.cells[0], leaps.cells[1], leaps.cells[2]}, 1, "unorm8",
                                   leap_bytes(leaps)));
    }
    textures.push_back(shift_texture(clouds));
    return json;
}

// --- Light ---------------------------------------------------------------------------------------

// Returns the two tables of the recipe's atmosphere, or of the preset `earth` if it has none.
Outcome<PreviewAssets> bake_light(const PreviewAssets& assets, const PreviewOptions& options) {
    const auto light = options.light != nullptr ? options.light : std::make_shared<PictureLight>();
    return light->tables(stated_air(&*assets.recipe),
                         {.threads = options.threads, .progress = options.progress});
}

// --- The view ------------------------------------------------------------------------------------

// The names of tone curves, in the order of ToneCurve.
constexpr std::array kCurves = {"film", "exponential", "aces", "agx"};

// Returns the exposed light that each curve shows as `share` of white, times a factor.
Json light_json(double share, double factor) {
    Image2<float> grey(1, 1, 1);
    grey.texels[0] = 1;
    const ExposureRule rule = {1, share, factor};
    Json light;
    for (std::size_t i = 0; i < kCurves.size(); ++i) {
        light[kCurves[i]] = exposure_by(rule, grey, static_cast<ToneCurve>(i));
    }
    return light;
}

// Returns the rule by which the page chooses exposures: they make the quantile of luminance as bright as
// `light` says for each curve, another quantile at most as bright as `bright_light` says, and the median at
// least as bright as `least_median` says.
Json exposure_json(const ExposureRule& rule) {
    return {
        {"quantile", rule.quantile},
        {"light", light_json(rule.share, rule.factor)},
        {"lit_pixels", rule.lit_pixels},
        {"bright_quantile", rule.bright_quantile},
        {"bright_light",
         rule.bright_quantile > 0 ? light_json(rule.bright_share, 1) : Json(nullptr)},
        {"least_median", rule.least_median > 0 ? light_json(rule.least_median, 1) : Json(nullptr)}};
}

// The factors of exposures for suns from `first_deg` on, each `step_deg` higher than the one before, up to the sun by
// day.
Json dimming_json(const RuntimeAir& light, int threads) {
    constexpr double kFirst = -18, kStep = 3;
    std::vector<SunDirection> suns;
    for (double sun = kFirst; sun <= kDaylightElevation; sun += kStep) suns.push_back({sun, 0});
    const auto factors =
        mapped<double>(daylight_shares({light.medium, light.tables}, suns, threads), dimming);
    return {{"first_deg", kFirst}, {"step_deg", kStep}, {"factors", factors}};
}

Json view_json(const PreviewOptions& options, const CloudCamera& camera, double thickness_km) {
    const double sun_deg =
        options.sun_elevations_deg.empty() ? 20 : options.sun_elevations_deg.front();
    const auto curve = static_cast<std::size_t>(options.tone_curve.value_or(ToneCurve::film));
    const double azimuth_deg =
        options.sun_azimuth_deg.value_or(camera.azimuth_degrees + kSunBesideView);
    return {{"position", {camera.position_m.x, camera.position_m.y, camera.position_m.z}},
            {"heading", camera.azimuth_degrees},
            {"pitch", camera.elevation_degrees},
            {"fov", camera.horizontal_field_degrees},
            {"sun_elevation", sun_deg},
            {"sun_azimuth", std::remainder(azimuth_deg, 360)},
            {"glare", options.glare.value_or(Glare::none) != Glare::none},
            {"exposure", options.exposure_stops ? Json(*options.exposure_stops) : Json(nullptr)},
            {"tone_curve", kCurves[curve]},
            {"top", 1000 * thickness_km}};
}

// Returns the camera of a sky without clouds.
CloudCamera sky_camera(const PreviewOptions& options) {
    const CameraRequest request = options.camera.value_or(CameraRequest());
    const std::array<double, 3> place =
        request.position_m.value_or(std::array{0.0, 0.0, options.altitude_m.value_or(200)});
    return {{place[0], place[1], place[2]},
            request.heading_degrees.value_or(90),
            request.pitch_degrees.value_or(12),
            request.field_degrees.value_or(70)};
}

Json scene_of(const PreviewAssets& assets, const PreviewOptions& options, const RuntimeAir& light,
              const std::string& light_name) {
    Json scene = {{"title", assets.title}, {"notes", assets.notes}, {"light", light_name}};
    scene["air"] = live_air_glsl(light);
    for (const PreviewAsset* asset : {light.transmittance, light.multiple_scattering}) {
        const std::string& name = asset->entry.name;
        scene["textures"].push_back(table_texture(table_name(name), name, asset->table));
    }
    if (has_phase_rows(light.medium)) {
        scene["textures"].push_back(table_texture(phase_rows_name, "phase functions of the recipe",
                                                  live_phases(light.medium)));
    }
    CloudCamera camera = sky_camera(options);
    scene["clouds"] = Json::array();
    scene["cloud_glsl"] = "";
    if (const std::vector<LiveCloud> clouds = live_clouds(assets, options); !clouds.empty()) {
        const FramedScene framed = framed_clouds(clouds, 960, 540);
        camera = framed.camera;
        scene["clouds"] = clouds_json(clouds, framed, scene["textures"]);
        scene["cloud_glsl"] = live_cloud_glsl(clouds);
    }
    scene["exposure"] = exposure_json(scene["clouds"].empty() ? kSkyPicture : kCloudPicture);
    scene["exposure"]["dimming"] = dimming_json(light, options.threads);
    scene["view"] = view_json(options, camera, light.medium.air.thickness_km);
    return scene;
}

}  // namespace

Outcome<std::string> live_scene(const PreviewAssets& assets, const PreviewOptions& options) {
    if (!assets.recipe) {
        return diagnosis("E0001", "--live needs the numbers of a recipe, and these files name none",
                         "show the folder of a bake, or a recipe");
    }
    std::string light_name = "the recipe's atmosphere";
    std::optional<RuntimeAir> light = runtime_air(*assets.recipe, assets, options.threads);
    PreviewAssets baked;
    if (!light) {
        auto made = bake_light(assets, options);
        if (!made.value) return {{}, std::move(made.diagnostics)};
        baked = std::move(*made.value);
        light = runtime_air(*baked.recipe, baked, options.threads);
        light_name = stated_air(&*assets.recipe) != nullptr
                         ? "the recipe's atmosphere, whose tables were baked for this page"
                         : "the preset earth, whose tables were baked for this page";
    }
    if (!has_colours(light)) {
        return {
            {},
            {diagnosis("E0001", "--live shows light of three or four channels",
                       fmt::format("this air has {}", light ? light->medium.air.channels : 0))}};
    }
    const Json scene = scene_of(assets, options, *light, light_name);
    return {scene.dump(-1, ' ', false, Json::error_handler_t::replace), {}};
}

}  // namespace skybake
