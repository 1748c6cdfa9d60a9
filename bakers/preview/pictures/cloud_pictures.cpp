#include "bakers/preview/pictures/cloud_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "bakers/assets/cloud_volume/cloud_volume.h"
#include "bakers/occupancy/cell_grid.h"
#include "bakers/preview/cloud_inputs.h"
#include "bakers/preview/pictures/asset_pictures.h"
#include "bakers/preview/pictures/cloud_lighting.h"
#include "bakers/render/stage_progress.h"
#include "config/assets/cloud_volume.h"
#include "config/assets/occupancy.h"

namespace skybake {
namespace {

// Returns the views under a sun: one, or those of a turntable.
std::vector<CloudViewSettings> views_of(const CloudPreviewInput& input, const CloudMedium& medium,
                                        const SunDirection& sun) {
    const auto [width, height] = drawn_size(input);
    if (input.turntable > 0) {
        return turntable_views(medium, sun, width, height, input.camera, input.turntable);
    }
    return {framed_view(medium, sun, width, height, input.camera)};
}

// The pictures of a cloud under one sun.
struct LitScene {
    const CloudPreviewInput& input;
    const Lighting& lighting;
    const SunDirection& sun;  // one of the input's
    const std::string& leaps_name;
    const std::optional<SolvedSky>& sky;
    const std::optional<LightInCloud>& light;  // within the cloud
    double daylight;                           // of daylight_shares
    SceneRenderer renderer;
};

std::string lit_caption(const LitScene& scene, const CloudViewSettings& settings,
                        const SceneFrame& frame, const CloudView& view, double exposure) {
    const double pixels = static_cast<double>(settings.width) * settings.height;
    const FetchCounts& fetches = view.fetches;
    return fmt::format(
        "{}. The sky is that of {}, with the {}, {}; {}; {}.\n"
        "The camera is `{}`. It takes {}, in steps of {:.3g} m, and of {:.3g} m towards the sun. "
        "{}. Leaping by {}, each pixel takes {:.0f} lookups of the volume and {:.0f} of the "
        "grid.{}",
        scene.input.single ? "The picture shows one tile alone, with its shadow on the ground"
                           : "The tile is repeated, fades out about 1.5 degrees from the "
                             "horizontal, and casts shadows on the ground",
        scene.lighting.name, sun_text(settings.sun.elevation_degrees),
        beside_view(settings.sun, settings.camera), sky_text(scene.sky),
        tone_text(exposure, scene.input.tone_curve), camera_text(settings.camera),
        samples_text(frame, view.refined_pixels), settings.step_m, settings.light_step_m,
        light_text(scene.light), scene.leaps_name,
        static_cast<double>(fetches.samples + fetches.light_samples) / pixels,
        static_cast<double>(fetches.cells) / pixels,
        scene.input.single ? "" : fmt::format(" {}", kCopiesText));
}

// Renders one view. Without `exposure`, one is chosen for this picture.
PreviewPicture lit_picture(LitScene& scene, const CloudViewSettings& settings,
                           std::optional<double> exposure, int threads, Progress* progress) {
    const SceneFrame frame = frame_of(settings.camera, settings.width, settings.height);
    const CloudView view = scene.renderer.render(frame, threads, progress);
    const Image2<float> shown = scene.lighting.tables.screen.shown(view.radiance);
    const ToneCurve curve = scene.input.tone_curve;
    if (!exposure) exposure = cloud_exposure_for(shown, curve, scene.daylight);
    PreviewPicture picture;
    picture.tab = sun_words(scene.input, scene.sun);
    picture.name =
        fmt::format("{}_lit_{}", scene.input.volume->entry.name, sun_name(scene.input, scene.sun));
    picture.title = fmt::format("Lit, {}", picture.tab);
    picture.caption = lit_caption(scene, settings, frame, view, *exposure);
    picture.picture = tone_mapped(shown, *exposure, curve);
    picture.exposure = exposure;
    picture.kind = PictureKind::scene;
    picture.group = "lit";
    return picture;
}

// Makes a picture of a turntable a part of its sequence.
void number_picture(const std::string& asset, std::size_t index, std::size_t count,
                    const CloudViewSettings& settings, PreviewPicture& picture) {
    const double elevation = settings.sun.elevation_degrees;
    picture.sequence = fmt::format("{}_turntable_{}", asset, sun_stem(elevation));
    picture.name = fmt::format("{}_{:03}", picture.sequence, index);
    picture.title = fmt::format("Turntable, {}", sun_text(elevation));
    picture.caption = fmt::format("Picture {} of {}. {}", index + 1, count, picture.caption);
}

// Makes the picture of a frame a part of the sequence that plays.
void join_frames(const SequenceFrame& frame, PreviewPicture& picture) {
    const std::string sun = picture.tab;
    picture.sequence = fmt::format("{}_frames_{}", frame.sequence,
                                   picture.name.substr(picture.name.rfind("sun_")));
    picture.name = fmt::format("{}_{:04}", picture.sequence, frame.index + 1);
    picture.title = fmt::format("{} plays, {}", frame.sequence, sun);
    picture.caption =
        fmt::format("Frame {} of {}. {}", frame.index + 1, frame.count, picture.caption);
    picture.frames_per_second = frame.per_second;
}

// The exposure that is known before the first picture of a sun is made.
std::optional<double> known_exposure(const CloudPreviewInput& input, std::size_t sun) {
    if (input.exposure_stops) return std::exp2(*input.exposure_stops);
    if (sun < input.exposures.size()) return input.exposures[sun];
    return std::nullopt;
}

// Returns the layer that is in all views.
SceneLayer layer_of(const CloudMedium& medium, const std::optional<LightInCloud>& light,
                    const std::vector<CloudViewSettings>& views) {
    SceneLayer layer = {&medium, views.front().step_m, views.front().light_step_m,
                        0,       kLightGrowth,         light ? &*light : nullptr};
    for (const CloudViewSettings& view : views) {
        layer.reach_m = std::max(layer.reach_m, view.reach_m);
    }
    return layer;
}

void add_lit_pictures(const CloudPreviewInput& input, const LeapingMedium& cloud,
                      const Lighting& lighting, int threads,
                      std::vector<PreviewPicture>& pictures) {
    const std::size_t count = static_cast<std::size_t>(std::max(input.turntable, 1));
    const double share = 1.0 / static_cast<double>(input.suns.size() * (count + 1) + 1);
    double done = share;
    ProgressPart solving(input.progress, "light within the cloud", 0, 0);
    const std::optional<cloud_light::MarchLight> within =
        light_within(input, cloud.medium, {.threads = threads, .progress = &solving});
    const std::vector<double> daylight =
        daylight_shares({lighting.medium, lighting.tables}, input.suns, threads);
    for (std::size_t s = 0; s < input.suns.size(); ++s) {
        const SunDirection& sun = input.suns[s];
        const std::string step = fmt::format("lighting, sun {:g} deg", sun.elevation_degrees);
        std::optional<double> exposure = known_exposure(input, s);
        const std::vector<CloudViewSettings> views = views_of(input, cloud.medium, sun);
        const auto sky = solved_sky(input, lighting, views.front().camera, sun, threads);
        ProgressPart of_sun(input.progress, step, done, 0);
        const auto light = light_under(within, lighting, cloud.medium, sun,
                                       {.threads = threads, .progress = &of_sun});
        done += share;
        const Atmosphere atmosphere = {lighting.medium, lighting.tables, sky ? &*sky : nullptr};
        LitScene scene = {
            input,
            lighting,
            sun,
            cloud.leaps_name,
            sky,
            light,
            daylight[s],
            SceneRenderer({layer_of(cloud.medium, light, views)}, atmosphere, sun, threads)};
        for (std::size_t i = 0; i < views.size() && !is_cancelled(input.progress); ++i) {
            ProgressPart part(input.progress, step, done, share);
            PreviewPicture picture = lit_picture(scene, views[i], exposure, threads, &part);
            done += share;
            exposure = picture.exposure;  // one for all pictures of a turntable
            if (input.turntable > 0) {
                number_picture(input.volume->entry.name, i, views.size(), views[i], picture);
            } else if (input.frame) {
                join_frames(*input.frame, picture);
            }
            pictures.push_back(std::move(picture));
        }
    }
}

void add_cells(const CloudPreviewInput& input, const CloudMedium& medium,
               const std::array<int, 3>& slices, std::vector<PreviewPicture>& pictures) {
    if (input.occupancy == nullptr || input.occupancy_bake == nullptr) return;
    const OccupancyBake& bake = *input.occupancy_bake;
    const auto leaps = leaps_of_grid(*input.occupancy, bake, filtered_threshold(*input.cloud));
    const std::array<int, 3> cells = occupancy::CellGrid{medium.volume.size, bake.cell}.size();
    if (!leaps || leaps->size() != occupancy::count_of(cells)) return;
    for (const int axis : {1, 2}) {
        pictures.push_back(cells_picture(medium, *input.volume, input.occupancy->entry.name,
                                         bake.cell, *leaps, axis,
                                         slices[static_cast<std::size_t>(axis)]));
        if (input.draft) return;
    }
}

}  // namespace

std::vector<PreviewPicture> cloud_pictures(const CloudPreviewInput& input, int threads) {
    const bool has_grid = input.occupancy != nullptr && has_all_texels(*input.occupancy);
    const std::optional<Cloud> cloud = cloud_as_baked(input);
    if (input.volume == nullptr || !cloud || !has_all_texels(*input.volume)) {
        if (!has_grid) return {};
        return grid_pictures(*input.occupancy, input.occupancy_bake, cloud ? &*cloud : nullptr,
                             input.draft);
    }
    const std::string& name = input.volume->entry.name;
    const LeapingMedium lit = leaping_medium(input, *cloud, !input.single, threads);
    const CloudMedium& medium = lit.medium;
    std::vector<PreviewPicture> pictures;
    if (const std::optional<Lighting> lighting = lighting_of(input, threads)) {
        add_lit_pictures(input, lit, *lighting, threads, pictures);
    }
    if (is_cancelled(input.progress)) return pictures;
    const Image2<float> depth = column_optical_depth(medium, threads);
    pictures.push_back(optical_depth_picture(medium, name, depth));
    const std::array<int, 3> slices = slice_voxel(medium, depth);
    for (const int axis : {1, 0, 2}) {
        pictures.push_back(
            slice_picture(medium, *input.volume, axis, slices[static_cast<std::size_t>(axis)]));
        if (input.draft) break;
    }
    if (has_grid) add_cells(input, medium, slices, pictures);
    return pictures;
}

}  // namespace skybake
