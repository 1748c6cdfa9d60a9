#include "bakers/preview/pictures/asset_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>

namespace skybake {
namespace {

// The kinds of assets that have their own pictures. Clouds are not among them, because their
// pictures also depend on the light.
struct AssetPictures {
    std::string_view kind;
    std::vector<PreviewPicture> (*pictures)(const PreviewAsset& asset);
};

constexpr AssetPictures kPictures[] = {
    {"transmittance", table_pictures},
    {"multiple_scattering", table_pictures},
    {"sky_view", sky_view_pictures},
    {"environment", environment_pictures},
    {"irradiance", irradiance_pictures},
    {"aerial_perspective", aerial_pictures},
    {"phase", phase_pictures},
    {"forward_scattering", forward_pictures},
    {"bruneton", bruneton_pictures},
    {"weather_map", weather_map_pictures},
    {"blue_noise", blue_noise_pictures},
    {"flipbook", flipbook_pictures},
    {"cloud_distance", distance_pictures},
};

}  // namespace

std::vector<PreviewPicture> asset_pictures(const PreviewAsset& asset) {
    for (const AssetPictures& row : kPictures) {
        if (row.kind == asset.entry.kind) return row.pictures(asset);
    }
    if (asset.entry.is_volume()) return noise_pictures(asset);
    return {};
}

// The factor is written without an exponent of ten.
std::string exposure_text(double exposure) {
    const std::string factor =
        exposure < 100 ? fmt::format("{:.3g}", exposure) : fmt::format("{:.0f}", exposure);
    return fmt::format("exposure {} ({:+.1f} stops)", factor, std::log2(exposure));
}

std::string tone_text(double exposure, ToneCurve curve) {
    return fmt::format("{}, tone curve {}", exposure_text(exposure), tone_curve_name(curve));
}

std::string sun_text(double elevation_degrees) {
    if (elevation_degrees == 0) return "sun on the horizon";
    const double size = std::fabs(elevation_degrees);
    return fmt::format("sun {:.4g} degree{} {} the horizon", size, size == 1 ? "" : "s",
                       elevation_degrees < 0 ? "below" : "above");
}

std::string sun_stem(double elevation_degrees) {
    std::string stem = fmt::format("sun_{}{:g}", elevation_degrees < 0 ? "minus_" : "",
                                   std::fabs(elevation_degrees));
    std::replace(stem.begin(), stem.end(), '.', '_');
    return stem;
}

Image2<float> slice(const VoxelView& volume, int channel, int axis, int at) {
    const auto across = static_cast<std::size_t>(axis == 0 ? 1 : 0);
    const auto up = static_cast<std::size_t>(axis == 2 ? 1 : 2);
    Image2<float> plane(volume.size[across], volume.size[up], 1);
    std::array<std::size_t, 3> place{};
    place[static_cast<std::size_t>(axis)] = static_cast<std::size_t>(at);
    const auto width = static_cast<std::size_t>(volume.size[0]);
    const auto height = static_cast<std::size_t>(volume.size[1]);
    for (int row = 0; row < plane.height; ++row) {
        for (int column = 0; column < plane.width; ++column) {
            place[across] = static_cast<std::size_t>(column);
            place[up] = static_cast<std::size_t>(row);
            const std::size_t voxel = (place[2] * height + place[1]) * width + place[0];
            *plane.texel(column, row) =
                (*volume.voxels)[voxel * static_cast<std::size_t>(volume.channels) +
                                 static_cast<std::size_t>(channel)];
        }
    }
    return plane;
}

Image2<float> tiled_twice(const Image2<float>& tile) {
    Image2<float> tiled(2 * tile.width, 2 * tile.height, 1);
    for (int y = 0; y < tiled.height; ++y) {
        for (int x = 0; x < tiled.width; ++x) {
            *tiled.texel(x, y) = *tile.texel(x % tile.width, y % tile.height);
        }
    }
    return tiled;
}

}  // namespace skybake
