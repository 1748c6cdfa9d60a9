#include "bakers/preview/pictures/cloud_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "bakers/assets/cloud_volume/cloud_volume.h"
#include "bakers/occupancy/cell_grid.h"
#include "bakers/preview/bake_assets.h"
#include "bakers/preview/occupancy_leaps.h"
#include "bakers/preview/pictures/asset_pictures.h"
#include "bakers/render/stage_progress.h"
#include "bakers/render/tone_curve.h"
#include "config/assets/cloud_volume.h"
#include "config/assets/occupancy.h"
#include "config/recipe/recipe.h"

namespace skybake {

namespace {

// The factor on the exposure that tone_curve.h chooses for whole pictures. It brings the 99th
// percentile to 0.78 of white, because clouds are the brightest part and their shades must be
// visible.
constexpr double kExposureShare = 0.8;

struct Lighting {
    SkyMedium medium;
    SkyTables tables;
    std::string name;  // as captions say it
};

std::optional<Lighting> lighting_of(const config::Atmosphere& atmosphere,
                                    const PreviewAsset& transmittance,
                                    const PreviewAsset& multiple_scattering, std::string name) {
    auto tables = make_sky_tables(transmittance, multiple_scattering);
    if (!tables.value) return std::nullopt;
    return Lighting{make_sky_medium(atmosphere), std::move(*tables.value), std::move(name)};
}

std::optional<Lighting> earth_lighting(int threads) {
    const auto recipe = config::parse_recipe(kEarthLight, "earth");
    if (!recipe.value) return std::nullopt;
    BakeOptions options;
    options.threads = threads;
    options.certification = Certification::off;
    const auto baked = bake_assets(*recipe.value, recipe.value->parameters.bakes, "earth", options);
    if (!baked.value) return std::nullopt;
    return lighting_of(recipe.value->parameters.atmosphere, *baked.value->of_kind("transmittance"),
                       *baked.value->of_kind("multiple_scattering"), "the preset earth");
}

std::optional<Lighting> lighting_of(const CloudPreviewInput& input, int threads) {
    if (input.atmosphere == nullptr || input.transmittance == nullptr ||
        input.multiple_scattering == nullptr) {
        return earth_lighting(threads);
    }
    return lighting_of(*input.atmosphere, *input.transmittance, *input.multiple_scattering,
                       "the recipe's atmosphere");
}

// The leaps of a march, and where they come from.
struct Leaps {
    LeapGrid grid;
    std::string name;  // as captions say it
};

Leaps leaps_of(const CloudPreviewInput& input, const CloudMedium& medium, int threads) {
    if (input.occupancy != nullptr && input.occupancy_bake != nullptr) {
        auto grid = leap_grid_of(*input.volume, *input.occupancy, *input.occupancy_bake,
                                 filtered_threshold(*input.cloud));
        if (grid) return {std::move(*grid), input.occupancy->entry.name};
    }
    return {leaps_of_voxels(medium, 4, threads), "cells made from the volume"};
}

// Returns the views under a sun: one, or those of a turntable.
std::vector<CloudViewSettings> views_of(const CloudPreviewInput& input, const CloudMedium& medium,
                                        const SunDirection& sun) {
    const int reduction = input.draft ? 2 : 1;
    const int width = std::max(input.width / reduction, 1);
    const int height = std::max(input.height / reduction, 1);
    std::vector<CloudViewSettings> views =
        input.turntable > 0
            ? turntable_views(medium, sun, width, height, input.camera, input.turntable)
            : std::vector{framed_view(medium, sun, width, height, input.camera)};
    for (CloudViewSettings& view : views) {
        view.step_m *= reduction;
        view.light_step_m *= reduction;
    }
    return views;
}

// Returns two samples along each edge of a pixel for small pictures, else one.
int samples_along_edge(const CloudViewSettings& settings) {
    return std::int64_t{settings.width} * settings.height <= kSmallPixels ? 2 : 1;
}

// Returns the means of squares of edge x edge pixels.
Image2<float> means_of_squares(const Image2<float>& image, int edge) {
    Image2<float> result(image.width / edge, image.height / edge, image.channels);
    const auto count = static_cast<float>(edge * edge);
    for (int y = 0; y < result.height * edge; ++y) {
        for (int x = 0; x < result.width * edge; ++x) {
            for (int c = 0; c < image.channels; ++c) {
                result.texel(x / edge, y / edge)[c] += image.texel(x, y)[c] / count;
            }
        }
    }
    return result;
}

CloudView render_samples(const CloudMedium& medium, const Lighting& lighting,
                         CloudViewSettings settings, int threads, Progress* progress) {
    const int edge = samples_along_edge(settings);
    settings.width *= edge;
    settings.height *= edge;
    CloudView view =
        render_cloud(medium, {lighting.medium, lighting.tables}, settings, threads, progress);
    if (edge > 1) view.radiance = means_of_squares(view.radiance, edge);
    return view;
}

// Says where the sun is for somebody who looks along the camera's heading. Azimuths grow from +x
// towards +y, which is to the left.
std::string beside_view(const SunDirection& sun, const CloudCamera& camera) {
    const double turn = std::remainder(sun.azimuth_degrees - camera.azimuth_degrees, 360.0);
    if (turn == 0) return "straight ahead";
    return fmt::format("{:.4g} degrees to the {} of the view", std::fabs(turn),
                       turn > 0 ? "left" : "right");
}

std::string lit_caption(const CloudPreviewInput& input, const CloudViewSettings& settings,
                        const Lighting& lighting, const Leaps& leaps, const FetchCounts& fetches,
                        double exposure) {
    const int samples = samples_along_edge(settings) * samples_along_edge(settings);
    const double pixels = static_cast<double>(settings.width) * settings.height;
    return fmt::format(
        "{}, the {}, {}, in the light of {}; {}. The camera is `{}`. There {} per pixel, {:.3g} m "
        "steps along the view and {:.3g} m steps towards the sun, and {} octaves of scattering "
        "(Wrenninge et al. 2013). Leaping by {}, each pixel takes {:.0f} lookups of the volume and "
        "{:.0f} of the grid.",
        input.single ? "One tile alone" : "The layer that the tile repeats to",
        sun_text(settings.sun.elevation_degrees), beside_view(settings.sun, settings.camera),
        lighting.name, tone_text(exposure, input.tone_curve), camera_text(settings.camera),
        samples == 1 ? std::string("is one sample") : fmt::format("are {} samples", samples),
        settings.step_m, settings.light_step_m, kOctaves, leaps.name,
        static_cast<double>(fetches.samples + fetches.light_samples) / pixels,
        static_cast<double>(fetches.cells) / pixels);
}

// Renders one view. Without `exposure`, one is chosen for this picture.
PreviewPicture lit_picture(const CloudPreviewInput& input, const CloudMedium& medium,
                           const Lighting& lighting, const Leaps& leaps,
                           const CloudViewSettings& settings, std::optional<double> exposure,
                           int threads, Progress* progress) {
    const CloudView view = render_samples(medium, lighting, settings, threads, progress);
    const Image2<float> shown = lighting.tables.screen.shown(view.radiance);
    if (!exposure) exposure = kExposureShare * exposure_for(shown, input.tone_curve);
    const double elevation = settings.sun.elevation_degrees;
    PreviewPicture picture;
    picture.name = fmt::format("{}_lit_{}", input.volume->entry.name, sun_stem(elevation));
    picture.title = fmt::format("Lit, {}", sun_text(elevation));
    picture.caption = lit_caption(input, settings, lighting, leaps, view.fetches, *exposure);
    picture.picture = tone_mapped(shown, *exposure, input.tone_curve);
    picture.exposure = exposure;
    picture.kind = PictureKind::scene;
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

void add_lit_pictures(const CloudPreviewInput& input, const CloudMedium& medium,
                      const Lighting& lighting, const Leaps& leaps, int threads,
                      std::vector<PreviewPicture>& pictures) {
    const std::size_t count = static_cast<std::size_t>(std::max(input.turntable, 1));
    const double share = 1.0 / static_cast<double>(input.suns.size() * count);
    double done = 0;
    for (const SunDirection& sun : input.suns) {
        const std::string step = fmt::format("lighting, sun {:g} deg", sun.elevation_degrees);
        std::optional<double> exposure;
        if (input.exposure_stops) exposure = std::exp2(*input.exposure_stops);
        const std::vector<CloudViewSettings> views = views_of(input, medium, sun);
        for (std::size_t i = 0; i < views.size() && !is_cancelled(input.progress); ++i) {
            ProgressPart part(input.progress, step, done, share);
            PreviewPicture picture =
                lit_picture(input, medium, lighting, leaps, views[i], exposure, threads, &part);
            done += share;
            exposure = picture.exposure;  // one for all pictures of a turntable
            if (input.turntable > 0) {
                number_picture(input.volume->entry.name, i, views.size(), views[i], picture);
            }
            pictures.push_back(std::move(picture));
        }
    }
}

void add_cells(const CloudPreviewInput& input, const CloudMedium& medium,
               const std::array<int, 3>& slices, std::vector<PreviewPicture>& pictures) {
    if (input.occupancy == nullptr || input.occupancy_bake == nullptr) return;
    const config::OccupancyBake& bake = *input.occupancy_bake;
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

bool holds_voxels(const PreviewAsset& asset) {
    const ManifestAsset& entry = asset.entry;
    if (!entry.is_volume() || entry.size.size() != 3 || entry.channels.empty()) return false;
    return asset.voxels.size() ==
           occupancy::count_of({entry.size[0], entry.size[1], entry.size[2]}) *
               entry.channels.size();
}

// Returns the cloud with the extent of its volume.
std::optional<config::Cloud> cloud_as_baked(const CloudPreviewInput& input) {
    if (input.cloud == nullptr) return std::nullopt;
    if (input.volume_bake == nullptr) return *input.cloud;
    return config::stretched(*input.cloud, *input.volume_bake);
}

}  // namespace

std::vector<PreviewPicture> cloud_pictures(const CloudPreviewInput& input, int threads) {
    const bool has_grid = input.occupancy != nullptr && holds_voxels(*input.occupancy);
    const std::optional<config::Cloud> cloud = cloud_as_baked(input);
    if (input.volume == nullptr || !cloud || !holds_voxels(*input.volume)) {
        if (!has_grid) return {};
        return grid_pictures(*input.occupancy, input.occupancy_bake, cloud ? &*cloud : nullptr,
                             input.draft);
    }
    const ManifestAsset& entry = input.volume->entry;
    CloudMedium medium = cloud_medium(
        *cloud, input.volume->voxels.data(), {entry.size[0], entry.size[1], entry.size[2]},
        static_cast<int>(entry.channels.size()), threads, !input.single);
    std::vector<PreviewPicture> pictures;
    if (const std::optional<Lighting> lighting = lighting_of(input, threads)) {
        Leaps leaps = leaps_of(input, medium, threads);
        medium.leaps = std::move(leaps.grid);
        add_lit_pictures(input, medium, *lighting, leaps, threads, pictures);
        if (is_cancelled(input.progress)) return pictures;
    }
    const Image2<float> depth = column_optical_depth(medium, threads);
    pictures.push_back(optical_depth_picture(medium, entry.name, depth));
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
