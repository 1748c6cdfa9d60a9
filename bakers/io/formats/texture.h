// Code that the formats of GPU textures, DDS and KTX2, share: the texels of a level, which are
// numbers or blocks of 4 x 4 texels of a slice (bakers/field/block_voxels.h).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "bakers/io/formats/format.h"
#include "config/sections/pixel_types.h"

namespace skybake {

struct Baked;

// Returns how many channels a texture stores: GPUs have no numbers in threes, so these have a
// fourth, which is 1. Blocks of bc6h count as such.
constexpr std::size_t stored_channels(std::size_t channels) { return channels == 3 ? 4 : channels; }

// The codes by which a format names texels of a type with one, two and four stored channels; 0: none.
struct TexelCodes {
    config::PixelType type;
    std::array<std::uint32_t, 3> codes;
};

// Returns the code for texels, or 0.
std::uint32_t texel_code(std::span<const TexelCodes> rows, config::PixelType type,
                         std::size_t channels);

// Finds a pixel type and stored channels by their code; nothing if no row has it.
struct TexelKind {
    config::PixelType type;
    std::size_t channels;
};
std::optional<TexelKind> texel_kind(std::span<const TexelCodes> rows, std::uint32_t code);

// Returns what textures cannot hold of the asset, in words, or nothing. `format` names them in the
// words: "DDS".
std::optional<std::string> texture_obstacle(const Baked& baked, const char* format);

// The size of a texture as containers state it.
struct TextureExtent {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::uint32_t depth = 0;   // 0: the texture is no volume
    std::uint32_t faces = 1;   // 6: it is a cube, whose faces have the width and the height
    std::uint32_t layers = 0;  // of an array of 2-D textures; 0: the texture is none
    bool operator==(const TextureExtent&) const = default;
};

TextureParts texture_parts(const Baked& baked);
std::string_view to_string(TextureParts parts);  // "none", "cube", "layers"
std::optional<TextureParts> texture_parts_of(std::string_view word);

// Whether each level of a cube is six squares. Other textures have no faces.
bool has_square_faces(std::array<int, 3> size, int levels, TextureParts parts);

// Returns the size of the next level. The layers of an array stay.
std::array<int, 3> next_texture_size(const std::array<int, 3>& size, TextureParts parts);

// Returns the size of a texture whose faces are squares.
TextureExtent texture_extent(const std::array<int, 3>& size, bool is_volume, TextureParts parts);

// Returns the bytes of a texel, or of a block.
std::size_t texel_bytes(config::PixelType type, std::size_t channels);

// Returns the bytes of a level.
std::uint64_t texture_bytes(const std::array<int, 3>& size, config::PixelType type,
                            std::size_t channels);

// Writes a level as write_texels does.
bool write_texture(const FileContent& content, int level, const TexelSink& put);

// Reads a level as read_texels does.
config::Outcome<bool> read_texture(const TexelInput& next, const std::array<int, 3>& size,
                                   config::PixelType type, std::size_t channels,
                                   const VoxelVisitor& visit);

}  // namespace skybake
