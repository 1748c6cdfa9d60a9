#include "bakers/preview/pictures/asset_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
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
    std::ranges::replace(stem, '.', '_');
    return stem;
}

VoxelView view_of(const PreviewAsset& asset) {
    const std::vector<int>& size = asset.entry.size;
    return {
        {size[0], size[1], size[2]}, static_cast<int>(asset.entry.channels.size()), &asset.voxels};
}

bool has_all_texels(const PreviewAsset& asset) {
    std::size_t values = asset.entry.channels.size();
    for (const int edge : asset.entry.size) values *= static_cast<std::size_t>(std::max(edge, 0));
    return asset.entry.size.size() == 3 && values > 0 && asset.voxels.size() == values;
}

Image2<float> slice_of(const PreviewAsset& asset, int z, int first, int count) {
    const std::vector<int>& size = asset.entry.size;
    const auto channels = asset.entry.channels.size();
    Image2<float> slice(size[0], size[1], count);
    const std::size_t texels =
        static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]);
    const float* voxel = asset.voxels.data() + static_cast<std::size_t>(z) * texels * channels;
    for (std::size_t i = 0; i < texels; ++i, voxel += channels) {
        std::copy_n(voxel + first, count,
                    slice.texels.data() + i * static_cast<std::size_t>(count));
    }
    return slice;
}

Image2<float> upwards(const Image2<float>& image, int first_row, int rows) {
    Image2<float> part(image.width, rows, image.channels);
    const auto row_values =
        static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.channels);
    for (int y = 0; y < rows; ++y) {
        std::copy_n(image.texel(0, first_row + y), row_values, part.texel(0, rows - 1 - y));
    }
    return part;
}

Image2<float> channel_of(const Image2<float>& image, std::size_t channel) {
    Image2<float> plane(image.width, image.height, 1);
    const auto channels = static_cast<std::size_t>(image.channels);
    for (std::size_t i = 0; i < plane.texels.size(); ++i) {
        plane.texels[i] = image.texels[i * channels + channel];
    }
    return plane;
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
