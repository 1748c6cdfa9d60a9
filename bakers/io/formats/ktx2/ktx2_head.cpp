#include "bakers/io/formats/ktx2/ktx2_head.h"

#include <algorithm>
#include <cstring>
#include <vector>

#include "bakers/field/pixel_type.h"
#include "bakers/field/stored_voxels.h"

namespace skybake {
namespace {

// VkFormat values.
constexpr std::array<TexelCodes, 7> vulkan = {{
    {PixelType::float32, {100, 103, 109}},
    {PixelType::half, {76, 83, 97}},
    {PixelType::unorm8, {9, 16, 37}},
    {PixelType::unorm16, {70, 77, 91}},
    {PixelType::bc4, {139, 0, 0}},
    {PixelType::bc5, {0, 141, 0}},
    {PixelType::bc6h, {0, 0, 143}},
}};

void append_number(std::string& bytes, const auto& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// A part of a texel or a block, as the data format descriptor has it.
struct Sample {
    std::size_t first_bit = 0;
    std::size_t bits = 0;
    std::uint8_t channel = 0;  // with qualifiers
    std::uint32_t lower = 0;   // the code of 0, or of -1
    std::uint32_t upper = 0;   // the code of 1
};

constexpr std::uint8_t is_signed = 0x40;
constexpr std::uint8_t is_float = 0x80;

// Returns the parts of a texel of numbers, in the order red, green, blue, alpha.
std::vector<Sample> samples_of_numbers(PixelType type, std::size_t stored) {
    constexpr std::array<std::uint8_t, 4> channels = {0, 1, 2, 15};
    const std::size_t bits = 8 * bytes_per_value(type);
    const bool is_unorm = type == PixelType::unorm8 || type == PixelType::unorm16;
    std::vector<Sample> samples;
    for (std::size_t i = 0; i < stored; ++i) {
        Sample sample{i * bits, bits, channels[i], 0, (1U << (bits % 32)) - 1};
        if (!is_unorm) {
            sample.channel |= is_signed | is_float;
            sample.lower = std::bit_cast<std::uint32_t>(-1.0F);
            sample.upper = std::bit_cast<std::uint32_t>(1.0F);
        }
        samples.push_back(sample);
    }
    return samples;
}

std::vector<Sample> samples_of(PixelType type, std::size_t stored) {
    constexpr std::uint32_t all = 0xFFFFFFFFU;
    if (type == PixelType::bc4) return {{0, 64, 0, 0, all}};
    if (type == PixelType::bc5) return {{0, 64, 0, 0, all}, {64, 64, 1, 0, all}};
    if (type == PixelType::bc6h) {
        return {{0, 128, is_float, 0, std::bit_cast<std::uint32_t>(1.0F)}};
    }
    return samples_of_numbers(type, stored);
}

std::uint8_t color_model(PixelType type) {
    if (type == PixelType::bc4) return 131;
    if (type == PixelType::bc5) return 132;
    return type == PixelType::bc6h ? 133 : 1;  // RGB
}

}  // namespace

std::string data_format_descriptor(PixelType type, std::size_t stored) {
    constexpr std::uint16_t version_1_3 = 2;
    constexpr std::array<std::uint8_t, 3> unspecified_linear_straight = {0, 1, 0};
    const std::uint8_t last = config::is_block_coded(type) ? 3 : 0;  // row and column of a block
    const std::vector<Sample> samples = samples_of(type, stored);
    const std::size_t block = 24 + 16 * samples.size();
    std::string bytes;
    append_number(bytes, static_cast<std::uint32_t>(block + 4));
    append_number(bytes, std::uint32_t{0});  // of Khronos, basic
    append_number(bytes, version_1_3);
    append_number(bytes, static_cast<std::uint16_t>(block));
    append_number(bytes, color_model(type));
    append_number(bytes, unspecified_linear_straight);
    append_number(bytes, std::array<std::uint8_t, 4>{last, last});
    append_number(
        bytes, std::array<std::uint8_t, 8>{static_cast<std::uint8_t>(texel_bytes(type, stored))});
    for (const Sample& sample : samples) {
        append_number(bytes, static_cast<std::uint16_t>(sample.first_bit));
        append_number(bytes, static_cast<std::uint8_t>(sample.bits - 1));
        append_number(bytes, sample.channel);
        append_number(bytes, std::uint32_t{0});  // position in the block
        append_number(bytes, sample.lower);
        append_number(bytes, sample.upper);
    }
    return bytes;
}

void append_ktx2_value(std::string_view key, std::string_view value, std::string& values) {
    append_number(values, static_cast<std::uint32_t>(key.size() + value.size() + 2));
    values.append(key).push_back('\0');
    values.append(value).push_back('\0');
    values.resize((values.size() + 3) / 4 * 4);
}

std::uint64_t aligned_level(std::uint64_t offset, PixelType type, std::size_t stored) {
    const std::uint64_t unit = std::max<std::uint64_t>(4, texel_bytes(type, stored));
    return (offset + unit - 1) / unit * unit;
}

std::optional<std::string> ktx2_value(std::string_view values, std::string_view key) {
    while (values.size() >= 4) {
        std::uint32_t bytes = 0;
        std::memcpy(&bytes, values.data(), sizeof bytes);
        values.remove_prefix(4);
        if (bytes > values.size()) return std::nullopt;
        const std::string_view pair = values.substr(0, bytes);
        const std::size_t end = pair.find('\0');
        if (end != pair.npos && pair.substr(0, end) == key) {
            std::string_view value = pair.substr(end + 1);
            if (value.ends_with('\0')) value.remove_suffix(1);
            return std::string(value);
        }
        values.remove_prefix(std::min<std::size_t>(values.size(), (bytes + 3U) / 4 * 4));
    }
    return std::nullopt;
}

std::string_view ktx2_orientation(const Ktx2Header& header) {
    return header.depth == 0 ? "rd" : "rdi";
}

std::optional<TexelKind> ktx2_texels(std::uint32_t vk_format) {
    return texel_kind(vulkan, vk_format);
}

Ktx2Header ktx2_header(const TextureExtent& extent, std::size_t stored, PixelType type,
                       std::size_t levels) {
    Ktx2Header header;
    header.vk_format = texel_code(vulkan, type, stored);
    header.type_size =
        config::is_block_coded(type) ? 1 : static_cast<std::uint32_t>(bytes_per_value(type));
    header.width = extent.width;
    header.height = extent.height;
    header.depth = extent.depth;
    header.layers = extent.layers;
    header.faces = extent.faces;
    header.levels = static_cast<std::uint32_t>(levels);
    header.descriptor_offset =
        static_cast<std::uint32_t>(sizeof(Ktx2Header) + levels * sizeof(LevelPlace));
    header.descriptor_bytes =
        static_cast<std::uint32_t>(data_format_descriptor(type, stored).size());
    header.values_offset = header.descriptor_offset + header.descriptor_bytes;
    return header;
}

}  // namespace skybake
