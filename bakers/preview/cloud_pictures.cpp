#include "bakers/preview/cloud_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "bakers/cloud/cloud_volume.h"
#include "bakers/preview/bake_assets.h"
#include "bakers/preview/cloud_slices.h"
#include "bakers/preview/occupancy_leaps.h"
#include "bakers/preview/tone_curve.h"
#include "config/cloud_extent.h"
#include "config/recipe.h"

namespace skybake {

namespace {

// What a cloud without an atmosphere of its own is lit by.
constexpr const char* kEarth =
    "preset = \"earth\"\n[bake.transmittance]\n[bake.multiple_scattering]\n"
    "mapping = \"twilight\"\nmax_texel_error = 0.02\n";

// Clouds are the brightest that there is to see, and their shades are to be seen: of the exposure
// for pictures as a whole (tone_curve.h), so that the 99th percentile is at 0.78 of white.
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
    const auto recipe = config::parse_recipe(kEarth, "earth");
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

// A march that leaps, and what it leaps by.
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

CloudViewSettings settings_of(const CloudPreviewInput& input, const CloudMedium& medium,
                              const SunDirection& sun) {
    if (!input.draft) return framed_view(medium, sun, input.width, input.height);
    CloudViewSettings settings =
        framed_view(medium, sun, std::max(input.width / 2, 1), std::max(input.height / 2, 1));
    settings.step_m *= 2;
    settings.light_step_m *= 2;
    return settings;
}

PreviewPicture lit_picture(const CloudPreviewInput& input, const CloudMedium& medium,
                           const Lighting& lighting, const Leaps& leaps, const SunDirection& sun,
                           int threads) {
    const CloudViewSettings settings = settings_of(input, medium, sun);
    const CloudView view =
        render_cloud(medium, {lighting.medium, lighting.tables}, settings, threads);
    const double exposure = input.exposure_stops ? std::exp2(*input.exposure_stops)
                                                 : kExposureShare * exposure_for(view.radiance);
    const double pixels = static_cast<double>(settings.width) * settings.height;
    PreviewPicture picture;
    picture.name = fmt::format("{}_lit_{:g}", input.volume->entry.name, sun.elevation_degrees);
    picture.title = fmt::format("Lit, the sun {:g} degrees high", sun.elevation_degrees);
    picture.caption = fmt::format(
        "Sun {:g} degrees high, {:g} degrees from the view's azimuth, in the light of {}; exposure "
        "{:.3g}, shown as {}. Steps of {:.3g} m, of {:.3g} m towards the sun; {} octaves of "
        "scattering (Wrenninge et al. 2013). Leaping by {}: {:.0f} fetches of the volume and "
        "{:.0f} "
        "of the grid a pixel.",
        sun.elevation_degrees, sun.azimuth_degrees - settings.camera.azimuth_degrees, lighting.name,
        exposure, tone_curve_name(), settings.step_m, settings.light_step_m, kOctaves, leaps.name,
        static_cast<double>(view.fetches.samples + view.fetches.light_samples) / pixels,
        static_cast<double>(view.fetches.cells) / pixels);
    picture.picture = tone_mapped(view.radiance, exposure);
    picture.exposure = exposure;
    return picture;
}

void add_cells(const CloudPreviewInput& input, const CloudMedium& medium,
               const std::array<int, 3>& telling, std::vector<PreviewPicture>& pictures) {
    if (input.occupancy == nullptr || input.occupancy_bake == nullptr) return;
    const config::OccupancyBake& bake = *input.occupancy_bake;
    const auto leaps = leaps_of_grid(*input.occupancy, bake, filtered_threshold(*input.cloud));
    const std::array<int, 3> cells = occupancy::CellGrid{medium.volume.size, bake.cell}.size();
    if (!leaps || leaps->size() != occupancy::count_of(cells)) return;
    for (const int axis : {1, 2}) {
        pictures.push_back(cells_picture(medium, *input.volume, input.occupancy->entry.name,
                                         bake.cell, *leaps, axis,
                                         telling[static_cast<std::size_t>(axis)]));
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

// With the extent that its volume has.
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
    CloudMedium medium = cloud_medium(*cloud, input.volume->voxels.data(),
                                      {entry.size[0], entry.size[1], entry.size[2]},
                                      static_cast<int>(entry.channels.size()), threads);
    std::vector<PreviewPicture> pictures;
    if (const std::optional<Lighting> lighting = lighting_of(input, threads)) {
        Leaps leaps = leaps_of(input, medium, threads);
        medium.leaps = std::move(leaps.grid);
        for (const SunDirection& sun : input.suns) {
            pictures.push_back(lit_picture(input, medium, *lighting, leaps, sun, threads));
        }
    }
    const Image2<float> depth = column_optical_depth(medium, threads);
    pictures.push_back(optical_depth_picture(medium, entry.name, depth));
    const std::array<int, 3> telling = telling_voxel(medium, depth);
    for (const int axis : {1, 0, 2}) {
        pictures.push_back(
            slice_picture(medium, *input.volume, axis, telling[static_cast<std::size_t>(axis)]));
        if (input.draft) break;
    }
    if (has_grid) add_cells(input, medium, telling, pictures);
    return pictures;
}

}  // namespace skybake
