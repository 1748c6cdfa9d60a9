#include "bakers/preview/pictures/telling_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "bakers/air/sky_medium.h"
#include "bakers/preview/cloud_input.h"
#include "bakers/preview/pictures/asset_pictures.h"
#include "bakers/preview/pictures/caption_words.h"
#include "bakers/preview/pictures/cloud_pictures.h"
#include "bakers/preview/pictures/volume_slices.h"
#include "bakers/render/sky_tables.h"
#include "bakers/render/sky_view.h"
#include "bakers/render/tone_curve.h"

namespace skybake {
namespace {

constexpr std::array<int, 2> telling_size = {384, 216};

std::array<int, 2> size_of(const PreviewOptions& options) {
    return options.picture_size.value_or(telling_size);
}

// The first picture's exposure becomes that of all.
double exposure_of(const Image2<float>& radiance, PreviewOptions& options) {
    if (!options.exposure_stops) options.exposure_stops = std::log2(exposure_for(radiance));
    return std::exp2(*options.exposure_stops);
}

std::string light_words(double exposure, double sun_elevation_degrees) {
    return fmt::format("{}, the {}", tone_text(exposure), sun_text(sun_elevation_degrees));
}

double sun_elevation_deg(const PreviewOptions& options) {
    return options.sun_elevations_deg.empty() ? 10 : options.sun_elevations_deg.front();
}

std::optional<TellingPicture> sky_picture(const PreviewAssets& assets, PreviewOptions& options) {
    const PreviewAsset* transmittance = assets.of_kind("transmittance");
    const PreviewAsset* scattering = assets.of_kind("multiple_scattering");
    if (!transmittance || !scattering || !assets.recipe) return std::nullopt;
    const auto tables = make_sky_tables(*transmittance, *scattering);
    if (!tables.value) return std::nullopt;
    SkyView view;
    view.projection = SkyProjection::panorama;
    view.width = size_of(options)[0];
    view.height = size_of(options)[1];
    const config::Atmosphere& atmosphere = assets.recipe->parameters.atmosphere;
    // The altitude that is not asked for may be above a thin shell's top.
    const double thickness_km =
        (atmosphere.top_radius.meters - atmosphere.ground_radius.meters) / 1000;
    view.camera_altitude_km = std::min(options.altitude_m.value_or(200) / 1000, thickness_km);
    view.sun_elevation_degrees = sun_elevation_deg(options);
    const SkyMedium medium = make_sky_medium(atmosphere);
    Image2<float> radiance = render_sky(medium, *tables.value, view, options.threads);
    add_sun_disc(medium, *tables.value, view, radiance);
    const double exposure = exposure_of(radiance, options);
    return TellingPicture{tone_mapped(radiance, exposure),
                          light_words(exposure, view.sun_elevation_degrees)};
}

// The first channel of the middle plane, 0 black and 1 white.
Picture slice_picture(const PreviewAsset& asset) {
    const ManifestAsset& entry = asset.entry;
    const VoxelView volume{entry.levels[0].size, static_cast<int>(entry.channels.size()),
                           &asset.voxels};
    const Image2<float> plane = slice(volume, 0, 2, volume.size[2] / 2);
    const int scale = std::max(1, telling_size[1] / std::max(plane.width, plane.height));
    Picture picture(plane.width * scale, plane.height * scale);
    std::uint8_t* out = picture.rgb.data();
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const float value = *plane.texel(x / scale, plane.height - 1 - y / scale);
            const float grey = 255 * std::clamp(value, 0.0f, 1.0f) + 0.5f;
            for (int c = 0; c < 3; ++c) *out++ = static_cast<std::uint8_t>(grey);
        }
    }
    return picture;
}

// Half of what is asked for, as a draft is.
std::optional<TellingPicture> cloud_picture(const PreviewAssets& assets, PreviewOptions& options) {
    for (const PreviewAsset& asset : assets.assets) {
        CloudPreviewInput input = cloud_input(assets, asset, options);
        if (input.cloud == nullptr || input.volume == nullptr) continue;
        input.width = 2 * size_of(options)[0];
        input.height = 2 * size_of(options)[1];
        input.draft = true;
        auto pictures = cloud_pictures(input, options.threads);
        if (pictures.empty()) continue;
        TellingPicture telling{std::move(pictures.front().picture), ""};
        if (const std::optional<double> exposure = pictures.front().exposure) {
            if (!options.exposure_stops) options.exposure_stops = std::log2(*exposure);
            telling.light = light_words(*exposure, input.suns.front().elevation_degrees);
        }
        return telling;
    }
    return std::nullopt;
}

}  // namespace

std::optional<TellingPicture> telling_picture(const PreviewAssets& assets,
                                              PreviewOptions& options) {
    if (auto cloud = cloud_picture(assets, options)) return cloud;
    if (auto sky = sky_picture(assets, options)) return sky;
    for (const PreviewAsset& asset : assets.assets) {
        if (!asset.voxels.empty()) return TellingPicture{slice_picture(asset), ""};
    }
    for (const PreviewAsset& asset : assets.assets) {
        auto pictures = asset_pictures(asset);
        if (!pictures.empty()) return TellingPicture{std::move(pictures.front().picture), ""};
    }
    return std::nullopt;
}

}  // namespace skybake
