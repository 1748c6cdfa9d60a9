#include "bakers/preview/live/live_textures.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>

#include "bakers/math/half_conversion.h"
#include "bakers/preview/page.h"

namespace skybake {
namespace {

std::string bytes_of(const void* data, std::size_t size) {
    std::string bytes(size, '\0');
    std::memcpy(bytes.data(), data, size);
    return bytes;
}

}  // namespace

LiveJson texture(const std::string& name, const std::string& label, std::vector<int> size,
                 int channels, const char* type, const std::string& texels) {
    return {{"name", name},         {"label", label}, {"size", std::move(size)},
            {"channels", channels}, {"type", type},   {"texels", base64(zlib_bytes(texels))}};
}

LiveJson table_texture(const std::string& name, const std::string& label,
                       const Image2<float>& table) {
    return texture(name, label, {table.width, table.height}, table.channels, "float",
                   bytes_of(table.texels.data(), table.texels.size() * sizeof(float)));
}

PackedVolume packed_volume(const PreviewAsset& asset) {
    const std::size_t channels = asset.entry.channels.size();
    std::vector<float> values;
    values.reserve(asset.voxels.size() / channels);
    for (std::size_t i = 0; i < asset.voxels.size(); i += channels) {
        values.push_back(asset.voxels[i]);
    }
    const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
    const bool fits = *least >= 0 && *greatest <= 1;
    const bool is_unorm8 = fits && std::all_of(values.begin(), values.end(), [](float value) {
                               return std::round(value * 255) / 255 == value;
                           });
    PackedVolume packed;
    if (is_unorm8 || (fits && 2 * values.size() > kMostHalfBytes)) {
        packed.type = "unorm8";
        packed.texels.reserve(values.size());
        for (const float value : values) {
            const float level = std::round(value * 255);
            packed.greatest_error =
                std::max(packed.greatest_error, std::fabs(double{level} / 255 - double{value}));
            packed.texels += static_cast<char>(static_cast<std::uint8_t>(level));
        }
        return packed;
    }
    std::vector<std::uint16_t> halves;
    halves.reserve(values.size());
    for (const float value : values) {
        halves.push_back(half_of_float(value));
        packed.greatest_error = std::max(
            packed.greatest_error, std::fabs(double{float_of_half(halves.back())} - double{value}));
    }
    packed.texels = bytes_of(halves.data(), 2 * halves.size());
    return packed;
}

std::string leap_bytes(const LeapGrid& grid) {
    std::string bytes;
    bytes.reserve(grid.reach.size());
    for (const float reach : grid.reach) {
        const float leap = reach < 0 ? 0 : 1 + std::floor(reach / static_cast<float>(grid.cell));
        bytes += static_cast<char>(static_cast<std::uint8_t>(std::min(leap, 255.0F)));
    }
    return bytes;
}

}  // namespace skybake
