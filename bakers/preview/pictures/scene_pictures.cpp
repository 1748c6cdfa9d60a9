#include "bakers/preview/pictures/scene_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>

#include "bakers/preview/pictures/asset_pictures.h"
#include "bakers/preview/pictures/cloud_lighting.h"
#include "bakers/render/stage_progress.h"
#include "bakers/render/tone_curve.h"
#include "config/text/mapped.h"

namespace skybake {
namespace {

// A layer in memory.
struct NamedLayer {
    std::string name;
    LeapingMedium cloud;
    std::optional<cloud_light::MarchLight> light;
};

std::vector<NamedLayer> layers_in_memory(const std::vector<CloudPreviewInput>& inputs,
                                         int threads) {
    std::vector<NamedLayer> layers;
    for (const CloudPreviewInput& input : inputs) {
        const std::optional<Cloud> cloud = cloud_as_baked(input);
        if (input.volume == nullptr || !cloud || !has_all_texels(*input.volume)) continue;
        LeapingMedium medium = leaping_medium(input, *cloud, true, threads);
        ProgressPart solving(input.progress, "light within the clouds", 0, 0);
        std::optional<cloud_light::MarchLight> light =
            light_within(input, medium.medium, {.threads = threads, .progress = &solving});
        layers.push_back({input.volume->entry.name, std::move(medium), std::move(light)});
    }
    return layers;
}

// "cumulus from 1.2 to 1.95 km".
std::string layer_text(const NamedLayer& layer) {
    const CloudMedium& medium = layer.cloud.medium;
    return fmt::format("{} from {:.4g} to {:.4g} km", layer.name, medium.base_m / 1000,
                       (medium.base_m + medium.extent_m[2]) / 1000);
}

std::string layers_text(const std::vector<NamedLayer>& layers) {
    auto rising = mapped<const NamedLayer*>(layers, [](const NamedLayer& layer) { return &layer; });
    std::ranges::stable_sort(rising, [](const NamedLayer* a, const NamedLayer* b) {
        return a->cloud.medium.base_m < b->cloud.medium.base_m;
    });
    std::string text;
    for (std::size_t i = 0; i < rising.size(); ++i) {
        if (i > 0) text += i + 1 == rising.size() ? " and " : ", ";
        text += layer_text(*rising[i]);
    }
    return text;
}

FramedScene framed(const CloudPreviewInput& input, const std::vector<NamedLayer>& layers,
                   const SunDirection& sun) {
    std::vector<const CloudMedium*> media;
    for (const NamedLayer& layer : layers) media.push_back(&layer.cloud.medium);
    return framed_scene(media, sun, input.width, input.height, input.camera);
}

std::string scene_caption(const CloudPreviewInput& input, const Lighting& lighting,
                          const std::vector<NamedLayer>& layers, const SunDirection& sun,
                          const std::optional<SolvedSky>& sky, const SceneFrame& frame,
                          const CloudView& view, double exposure) {
    return fmt::format(
        "The picture shows {} in one sky. Its light is that of {}, with the {}, {}; {}; {}.\n"
        "The camera is `{}`. It takes {}. {} Far layers fade out about 1.5 degrees above the "
        "horizon. Layers are flat, and clouds do not shade the air.",
        layers_text(layers), lighting.name, sun_text(sun.elevation_degrees),
        beside_view(sun, frame.camera), sky_text(sky), tone_text(exposure, input.tone_curve),
        camera_text(frame.camera), samples_text(frame, view.refined_pixels), kCopiesText);
}

PreviewPicture scene_picture(const CloudPreviewInput& input, const Lighting& lighting,
                             const std::vector<NamedLayer>& layers, const SunDirection& sun,
                             double daylight, int threads, Progress* progress) {
    FramedScene scene = framed(input, layers, sun);
    ProgressPart solving(progress, "light within the clouds", 0, 0);
    const auto lights = mapped<std::optional<LightInCloud>>(layers, [&](const NamedLayer& layer) {
        return light_under(layer.light, lighting, layer.cloud.medium, sun,
                           {.threads = threads, .progress = &solving});
    });
    for (std::size_t l = 0; l < layers.size(); ++l) {
        if (lights[l]) scene.layers[l].solved = &*lights[l];
    }
    const auto [width, height] = drawn_size(input);
    const SceneFrame frame = frame_of(scene.camera, width, height);
    const auto sky = solved_sky(input, lighting, scene.camera, sun, threads);
    SceneRenderer renderer(scene.layers, {lighting.medium, lighting.tables, sky ? &*sky : nullptr},
                           sun, threads);
    const CloudView view = renderer.render(frame, threads, progress);
    const Image2<float> shown = lighting.tables.screen.shown(view.radiance);
    const double exposure = input.exposure_stops
                                ? std::exp2(*input.exposure_stops)
                                : cloud_exposure_for(shown, input.tone_curve, daylight);
    PreviewPicture picture;
    picture.tab = sun_words(input, sun);
    picture.name = "scene_" + sun_name(input, sun);
    picture.title = fmt::format("One sky, {}", picture.tab);
    picture.caption = scene_caption(input, lighting, layers, sun, sky, frame, view, exposure);
    picture.picture = tone_mapped(shown, exposure, input.tone_curve);
    picture.exposure = exposure;
    picture.kind = PictureKind::scene;
    picture.group = "scene";
    return picture;
}

}  // namespace

std::vector<PreviewPicture> scene_pictures(const std::vector<CloudPreviewInput>& inputs,
                                           int threads) {
    std::vector<PreviewPicture> pictures;
    if (inputs.empty()) return pictures;
    const CloudPreviewInput& first = inputs.front();
    const std::vector<NamedLayer> layers = layers_in_memory(inputs, threads);
    const std::optional<Lighting> lighting = lighting_of(first, threads);
    if (layers.empty() || !lighting) return pictures;
    const double share = 1.0 / static_cast<double>(first.suns.size());
    const std::vector<double> daylight =
        daylight_shares({lighting->medium, lighting->tables}, first.suns, threads);
    for (const SunDirection& sun : first.suns) {
        if (is_cancelled(first.progress)) return pictures;
        ProgressPart part(first.progress, fmt::format("sun {:g} deg", sun.elevation_degrees),
                          share * static_cast<double>(pictures.size()), share);
        pictures.push_back(scene_picture(first, *lighting, layers, sun, daylight[pictures.size()],
                                         threads, &part));
    }
    return pictures;
}

}  // namespace skybake
