// The head of a KTX2 file: header, index of levels, data format descriptor, keys and values.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "bakers/io/formats/texture.h"

namespace skybake {

static_assert(std::endian::native == std::endian::little,
              "headers are stored as they lie in memory");

// The members of the file's header in their order.
struct Ktx2Header {
    std::array<unsigned char, 12> identifier = {0xAB, 'K',  'T',  'X',  ' ',  '2',
                                                '0',  0xBB, '\r', '\n', 0x1A, '\n'};
    std::uint32_t vk_format = 0;
    std::uint32_t type_size = 0;  // bytes of a number
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::uint32_t depth = 0;   // 0 of a 2-D texture
    std::uint32_t layers = 0;  // 0: no array
    std::uint32_t faces = 1;
    std::uint32_t levels = 0;
    std::uint32_t compression = 0;
    std::uint32_t descriptor_offset = 0;
    std::uint32_t descriptor_bytes = 0;
    std::uint32_t values_offset = 0;
    std::uint32_t values_bytes = 0;
    std::uint64_t globals_offset = 0;
    std::uint64_t globals_bytes = 0;

    TextureExtent extent() const { return {width, height, depth, faces, layers}; }
};
static_assert(sizeof(Ktx2Header) == 80);

// Where a level lies in the file.
struct LevelPlace {
    std::uint64_t offset = 0;
    std::uint64_t bytes = 0;
    std::uint64_t uncompressed_bytes = 0;
};

inline constexpr std::uint32_t uncompressed = 0;
inline constexpr std::uint32_t zstandard = 2;
inline constexpr std::uint32_t most_levels = 32;         // of any texture
inline constexpr std::uint32_t most_values = 64U << 20;  // bytes of keys and values that are read
inline constexpr std::uint32_t most_descriptor = 64U << 10;

// Returns the header of a texture, but for what is said of keys and values.
Ktx2Header ktx2_header(const TextureExtent& extent, std::size_t stored, config::PixelType type,
                       std::size_t levels);

// Finds the texels that a VkFormat stands for; nothing if skybake does not write them.
std::optional<TexelKind> ktx2_texels(std::uint32_t vk_format);

// Returns the basic descriptor block of the Khronos Data Format Specification, after its length.
std::string data_format_descriptor(config::PixelType type, std::size_t stored);

// Appends a key and its value, which is a text.
void append_ktx2_value(std::string_view key, std::string_view value, std::string& values);

// Returns the value of a key, without the 0 at its end; nothing if the key is not among them.
std::optional<std::string> ktx2_value(std::string_view values, std::string_view key);

// The value of KTXorientation: texel (0, 0, 0) has the smallest texture coordinates.
std::string_view ktx2_orientation(const Ktx2Header& header);

// Where levels that are not compressed begin: at multiples of their texels, and of 4 bytes.
std::uint64_t aligned_level(std::uint64_t offset, config::PixelType type, std::size_t stored);

}  // namespace skybake
