#include "bakers/preview/live/live_clouds.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "bakers/march/cloud_light.h"
#include "bakers/preview/cloud_inputs.h"
#include "bakers/preview/pictures/cloud_lighting.h"

namespace skybake {
namespace {

std::vector<CloudPreviewInput> shown_inputs(const PreviewAssets& assets,
                                            const PreviewOptions& options) {
    std::vector<CloudPreviewInput> inputs = scene_input(assets, options);
    std::erase_if(inputs,
                  [](const CloudPreviewInput& input) { return !holds_voxels(*input.volume); });
    if (options.single && inputs.size() > 1) inputs.resize(1);
    return inputs;
}

// Returns the first voxel that each copy reads, along x and y (TileVariation).
LiveJson shift_texture(const std::vector<LiveCloud>& clouds) {
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

LiveJson cloud_json(const LiveCloud& cloud, const SceneLayer& layer, double greatest_error) {
    const CloudMedium& medium = cloud.medium;
    const CloudOptics& optics = medium.optics;
    const double g = mean_cosine(droplet_phase(kDropletDiameter_um));
    return {{"name", cloud.volume->entry.name},
            {"leaps", cloud.leaps_name},
            {"greatest_error", greatest_error},
            {"tile", medium.extent_m},
            {"base", medium.base_m},
            {"extinction", optics.extinction_per_m},
            {"threshold", optics.has_edge ? LiveJson(optics.threshold) : LiveJson(nullptr)},
            {"edge_softness", optics.edge_softness},
            {"backward", (1 - g) / 2},
            {"step", layer.step_m},
            {"voxel_edge", voxel_edge_m(medium)},
            {"most_sun_samples", kSunSamples},
            {"reach", medium.repeats ? usual_steps(medium, {}).reach_m : 1e6},
            {"farthest_reach", layer.fades ? farthest_reach_m(medium) : 0},
            {"end_slope", sine_of_degrees(kEndElevation)},
            {"fade_from", layer.fades ? LiveJson(kFadeFrom) : LiveJson(nullptr)},
            {"repeats", medium.repeats}};
}

}  // namespace

std::vector<LiveCloud> live_clouds(const PreviewAssets& assets, const PreviewOptions& options) {
    const std::vector<CloudPreviewInput> inputs = shown_inputs(assets, options);
    std::vector<LiveCloud> clouds;
    for (const CloudPreviewInput& input : inputs) {
        const std::optional<config::Cloud> cloud = cloud_as_baked(input);
        LeapingMedium made = leaping_medium(input, *cloud, !options.single, options.threads);
        // The page can show the layer even where it first shows a single tile.
        if (options.single) made.medium.variation = varied_tiles(made.medium);
        clouds.push_back({input.volume, std::move(made.medium), std::move(made.leaps_name),
                          input.suns.front(), input.camera});
    }
    return clouds;
}

FramedScene framed_clouds(const std::vector<LiveCloud>& clouds, int width, int height) {
    const LiveCloud& first = clouds.front();
    if (clouds.size() == 1) {
        const CloudMedium& medium = first.medium;
        const CloudViewSettings view = framed_view(medium, first.sun, width, height, first.camera);
        return {{{&medium, view.step_m, view.light_step_m, view.reach_m, false}}, view.camera};
    }
    std::vector<const CloudMedium*> media;
    for (const LiveCloud& cloud : clouds) media.push_back(&cloud.medium);
    return framed_scene(media, first.sun, width, height, first.camera);
}

LiveJson clouds_json(const std::vector<LiveCloud>& clouds, const FramedScene& scene,
                     LiveJson& textures) {
    LiveJson json = LiveJson::array();
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

}  // namespace skybake
