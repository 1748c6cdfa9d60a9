#include "bakers/preview/pictures/cloud_lighting.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "bakers/air/ray.h"
#include "bakers/assets/cloud_volume/cloud_volume.h"
#include "bakers/preview/bake_assets.h"
#include "bakers/preview/cloud_inputs.h"
#include "bakers/preview/pictures/asset_pictures.h"
#include "bakers/render/cloud_view.h"
#include "config/recipe/recipe.h"

namespace skybake {
namespace {

std::optional<Lighting> lighting_of(const config::Atmosphere& atmosphere,
                                    const PreviewAsset& transmittance,
                                    const PreviewAsset& multiple_scattering, std::string name,
                                    int threads) {
    auto tables = make_sky_tables(transmittance, &multiple_scattering);
    if (!tables.value) return std::nullopt;
    Lighting lighting{make_sky_medium(atmosphere), std::move(*tables.value), std::move(name),
                      nullptr, nullptr};
    lighting.tables.screen = daylight_screen({lighting.medium, lighting.tables}, threads);
    return lighting;
}

BakeOptions bake_options(const CloudPreviewInput& input, int threads) {
    return {.threads = threads, .progress = input.progress};
}

// Whether the sun is the first again, before the camera.
bool is_against(const CloudPreviewInput& input, const SunDirection& sun) {
    return input.last_is_against && &sun == &input.suns.back();
}

}  // namespace

std::optional<Lighting> lighting_of(const CloudPreviewInput& input, int threads) {
    const auto light = input.light != nullptr ? input.light : std::make_shared<PictureLight>();
    std::optional<Lighting> lighting;
    if (input.air != nullptr && input.transmittance != nullptr &&
        input.multiple_scattering != nullptr) {
        lighting = lighting_of(input.air->parameters.atmosphere, *input.transmittance,
                               *input.multiple_scattering, "the recipe's atmosphere", threads);
        if (lighting) lighting->air = input.air;
    } else {
        const BakeOptions options = bake_options(input, threads);
        const Recipe* air = stated_air(input.air);
        auto tables = light->tables(air, options);
        if (!tables.value && air != nullptr && !options.cancelled()) {
            air = nullptr;  // whose light cannot be solved for
            tables = light->tables(nullptr, options);
        }
        if (!tables.value) return std::nullopt;
        lighting = lighting_of(
            tables.value->recipe->parameters.atmosphere, *tables.value->of_kind("transmittance"),
            *tables.value->of_kind("multiple_scattering"),
            air != nullptr ? "the recipe's atmosphere" : "the preset earth", threads);
        if (lighting) lighting->air = air;
    }
    if (lighting) lighting->light = light;
    return lighting;
}

std::optional<SolvedSky> solved_sky(const CloudPreviewInput& input, const Lighting& lighting,
                                    const CloudCamera& camera, const SunDirection& sun,
                                    int threads) {
    if (input.table_sky) return std::nullopt;
    return lighting.light->sky(
        lighting.air, {camera_altitude_km(lighting.medium.air, camera), sun.elevation_degrees},
        bake_options(input, threads));
}

std::optional<cloud_light::MarchLight> light_within(const CloudPreviewInput& input,
                                                    const CloudMedium& medium,
                                                    const BakeOptions& options) {
    if (input.table_sky) return std::nullopt;
    return cloud_light::MarchLight(
        medium, input.draft ? cloud_light::kCellsOfDraft : cloud_light::kCellsOfPicture, options);
}

std::optional<LightInCloud> light_under(const std::optional<cloud_light::MarchLight>& within,
                                        const Lighting& lighting, const CloudMedium& medium,
                                        const SunDirection& sun, const BakeOptions& options) {
    const Shell shell = shell_of(lighting.medium.air);
    const double top_km = (medium.base_m + medium.extent_m[2]) / 1000;
    const double dip = horizon_distance_km(shell, top_km) / (shell.ground_radius_km + top_km);
    const bool sees_sun = sine_of_degrees(sun.elevation_degrees) > -dip;
    auto light = within && sees_sun ? within->under(sun, options) : std::nullopt;
    const auto is_finite = [](float value) { return std::isfinite(value); };
    return light && std::ranges::all_of(light->values, is_finite) ? std::move(light) : std::nullopt;
}

std::string light_text(const std::optional<LightInCloud>& light) {
    if (!light) {
        return fmt::format("Light has {} octaves of scattering (Wrenninge et al. 2013)", kOctaves);
    }
    return fmt::format("Light of all orders of scattering is solved for in {} x {} x {} cells",
                       light->cells[0], light->cells[1], light->cells[2]);
}

std::string sky_text(const std::optional<SolvedSky>& solved) {
    return solved ? "the sky behind is solved for all orders of scattering"
                  : "the sky behind is that of the tables";
}

std::optional<Cloud> cloud_as_baked(const CloudPreviewInput& input) {
    if (input.cloud == nullptr) return std::nullopt;
    if (input.volume_bake == nullptr) return *input.cloud;
    return config::stretched(*input.cloud, *input.volume_bake);
}

LeapingMedium leaping_medium(const CloudPreviewInput& input, const Cloud& cloud, bool repeats,
                             int threads) {
    const ManifestAsset& entry = input.volume->entry;
    LeapingMedium result = {cloud_medium(cloud, input.volume->voxels.data(),
                                         {entry.size[0], entry.size[1], entry.size[2]},
                                         static_cast<int>(entry.channels.size()), threads, repeats),
                            "cells made from the volume"};
    if (repeats) result.medium.variation = varied_tiles(result.medium);
    if (input.occupancy != nullptr && input.occupancy_bake != nullptr) {
        auto grid = leap_grid_of(*input.volume, *input.occupancy, *input.occupancy_bake,
                                 filtered_threshold(*input.cloud));
        if (grid) {
            result.medium.leaps = std::move(*grid);
            result.leaps_name = input.occupancy->entry.name;
            return result;
        }
    }
    result.medium.leaps = leaps_of_voxels(result.medium, 4, threads);
    return result;
}

std::array<int, 2> drawn_size(const CloudPreviewInput& input) {
    const int reduction = input.draft ? 2 : 1;
    return {std::max(input.width / reduction, 1), std::max(input.height / reduction, 1)};
}

SceneFrame frame_of(const CloudCamera& camera, int width, int height) {
    const bool is_small = std::int64_t{width} * height <= kSmallPixels;
    return {width, height,     camera, is_small ? Refinement::all : Refinement::thin,
            true,  kStepGrowth};
}

std::string samples_text(const SceneFrame& frame, int refined_pixels) {
    if (frame.refinement == Refinement::all) return fmt::format("{} rays per pixel", kSamples);
    const double pixels = static_cast<double>(frame.width) * frame.height;
    return fmt::format("one ray per pixel, and {} in the {:.0f} % of pixels with grain or edges",
                       kSamples, 100 * refined_pixels / pixels);
}

std::string sun_words(const CloudPreviewInput& input, const SunDirection& sun) {
    return sun_text(sun.elevation_degrees) + (is_against(input, sun) ? ", against the light" : "");
}

std::string sun_name(const CloudPreviewInput& input, const SunDirection& sun) {
    return sun_stem(sun.elevation_degrees) + (is_against(input, sun) ? "_against" : "");
}

// Azimuths grow from +x towards +y, which is to the left.
std::string beside_view(const SunDirection& sun, const CloudCamera& camera) {
    const double turn = std::remainder(sun.azimuth_degrees - camera.azimuth_degrees, 360.0);
    if (std::fabs(turn) < 0.005) return "straight ahead";
    return fmt::format("{:.4g} degrees to the {} of the view", std::fabs(turn),
                       turn > 0 ? "left" : "right");
}

}  // namespace skybake
