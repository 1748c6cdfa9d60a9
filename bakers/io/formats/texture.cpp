#include "bakers/io/formats/texture.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "bakers/field/baked.h"
#include "bakers/field/bc4.h"
#include "bakers/field/bc6h.h"
#include "bakers/field/block_voxels.h"
#include "bakers/field/pixel_type.h"
#include "bakers/field/stored_voxels.h"
#include "bakers/field/take_boxes.h"

namespace skybake {
namespace {

constexpr std::array<std::size_t, 3> channels_of_codes = {1, 2, 4};
constexpr int texture_block_edge = 4;
constexpr std::uint32_t faces_of_cube = 6;

int blocks_along(int texels) { return (texels - 1) / texture_block_edge + 1; }

// The boxes in which blocks are made: rows of blocks of one slice.
class BlockBoxes {
  public:
    BlockBoxes(const std::array<int, 3>& size, std::size_t channels) : size_(size) {
        const std::int64_t row =
            std::int64_t{texture_block_edge} * size[0] * static_cast<std::int64_t>(channels);
        rows_ = texture_block_edge * static_cast<int>(std::clamp<std::int64_t>(
                                         BoxSequence::kFloats / row, 1, blocks_along(size[1])));
        parts_ = (size[1] - 1) / rows_ + 1;
    }
    int count() const { return parts_ * size_[2]; }
    VoxelBox operator[](int i) const {
        const int y = i % parts_ * rows_;
        return {{0, y, i / parts_}, {size_[0], std::min(rows_, size_[1] - y), 1}};
    }

  private:
    std::array<int, 3> size_;
    int rows_ = 0;  // per box
    int parts_ = 0;
};

bool write_blocks(const FileContent& content, int level_number, const TexelSink& put) {
    const Level& level = content.baked.levels[static_cast<std::size_t>(level_number)];
    const std::size_t channels = content.baked.channel_names.size();
    const BlockBoxes boxes(level.size, channels);
    return write_boxes<std::string>(
        boxes.count(), content.threads, content.progress,
        [&](int i, std::string& bytes) {
            bytes = coded_blocks(*level.uncoded, level.size, content.baked.pixel_type, channels,
                                 boxes[i]);
        },
        [&](int, const std::string& bytes) { return put(bytes); });
}

// Writes the texels of a block to rows of `width` texels, as far as they lie within.
void put_block(const std::uint8_t* block, PixelType type, std::size_t channels, int x, int width,
               int rows, std::vector<float>& values) {
    for (std::size_t c = 0; c < channels; ++c) {
        const std::array<float, 16> texels =
            type == PixelType::bc6h ? decode_bc6h(block)[c] : decode_bc4(block + c * bc4_bytes);
        for (int j = 0; j < rows; ++j) {
            for (int i = 0; i < std::min(texture_block_edge, width - x); ++i) {
                values[static_cast<std::size_t>(j * width + x + i) * channels + c] =
                    texels[static_cast<std::size_t>(texture_block_edge * j + i)];
            }
        }
    }
}

config::Outcome<bool> read_blocks(const TexelInput& next, const std::array<int, 3>& size,
                                  PixelType type, std::size_t channels, const VoxelVisitor& visit) {
    std::vector<std::uint8_t> blocks(static_cast<std::size_t>(blocks_along(size[0])) *
                                     bytes_per_block(type));
    std::vector<float> values;
    std::int64_t first = 0;
    for (int z = 0; z < size[2]; ++z) {
        for (int y = 0; y < size[1]; y += texture_block_edge) {
            const auto problem = next(reinterpret_cast<char*>(blocks.data()), blocks.size());
            if (problem) return *problem;
            const int rows = std::min(texture_block_edge, size[1] - y);
            values.resize(static_cast<std::size_t>(rows * size[0]) * channels);
            for (int x = 0; x < size[0]; x += texture_block_edge) {
                const auto at =
                    static_cast<std::size_t>(x / texture_block_edge) * bytes_per_block(type);
                put_block(&blocks[at], type, channels, x, size[0], rows, values);
            }
            const std::int64_t count = std::int64_t{rows} * size[0];
            if (!visit(first, count, values.data())) return {false, {}};
            first += count;
        }
    }
    return {true, {}};
}

}  // namespace

std::uint32_t texel_code(std::span<const TexelCodes> rows, PixelType type, std::size_t channels) {
    const auto row = std::ranges::find(rows, type, &TexelCodes::type);
    const auto column = std::ranges::find(channels_of_codes, stored_channels(channels));
    if (row == rows.end() || column == channels_of_codes.end()) return 0;
    return row->codes[static_cast<std::size_t>(column - channels_of_codes.begin())];
}

std::optional<TexelKind> texel_kind(std::span<const TexelCodes> rows, std::uint32_t code) {
    for (const TexelCodes& row : rows) {
        for (std::size_t i = 0; i < row.codes.size(); ++i) {
            if (code != 0 && row.codes[i] == code) return TexelKind{row.type, channels_of_codes[i]};
        }
    }
    return std::nullopt;
}

std::optional<std::string> texture_obstacle(const Baked& baked, const char* format) {
    if (baked.channel_names.size() > 4) {
        return fmt::format("{} files hold at most four channels", format);
    }
    if (config::is_block_coded(baked.pixel_type) && baked.levels.front().uncoded == nullptr) {
        return "the voxels have not been coded";
    }
    const auto levels = static_cast<int>(baked.levels.size());
    if (!has_square_faces(baked.levels.front().size, levels, texture_parts(baked))) {
        return "the faces of a cube are squares";
    }
    for (std::size_t i = 1; i < baked.levels.size(); ++i) {
        if (baked.levels[i].size ==
            next_texture_size(baked.levels[i - 1].size, texture_parts(baked))) {
            continue;
        }
        return fmt::format(
            "each level of a {} file has half the size of the one before, rounded down", format);
    }
    return std::nullopt;
}

TextureParts texture_parts(const Baked& baked) {
    return texture_parts_of(baked.mapping).value_or(TextureParts::none);
}

std::string_view to_string(TextureParts parts) {
    constexpr std::array<std::string_view, 3> kWords = {"none", "cube", "layers"};
    return kWords[static_cast<std::size_t>(parts)];
}

std::optional<TextureParts> texture_parts_of(std::string_view word) {
    for (const TextureParts parts :
         {TextureParts::none, TextureParts::cube, TextureParts::layers}) {
        if (to_string(parts) == word) return parts;
    }
    return std::nullopt;
}

std::array<int, 3> next_texture_size(const std::array<int, 3>& size, TextureParts parts) {
    return parts == TextureParts::layers ? next_slice_size(size) : next_mip_size(size);
}

bool has_square_faces(std::array<int, 3> size, int levels, TextureParts parts) {
    if (parts != TextureParts::cube) return true;
    for (int i = 0; i < levels; ++i, size = next_mip_size(size)) {
        if (size[1] != static_cast<int>(faces_of_cube) * size[0]) return false;
    }
    return true;
}

TextureExtent texture_extent(const std::array<int, 3>& size, bool is_volume, TextureParts parts) {
    TextureExtent extent = {static_cast<std::uint32_t>(size[0]),
                            static_cast<std::uint32_t>(size[1]),
                            is_volume ? static_cast<std::uint32_t>(size[2]) : 0};
    if (parts == TextureParts::cube) {
        extent.faces = faces_of_cube;
        extent.height /= faces_of_cube;
    }
    if (parts == TextureParts::layers) {
        extent.depth = 0;
        extent.layers = static_cast<std::uint32_t>(size[2]);
    }
    return extent;
}

std::size_t texel_bytes(PixelType type, std::size_t channels) {
    if (config::is_block_coded(type)) return bytes_per_block(type);
    return stored_channels(channels) * bytes_per_value(type);
}

std::uint64_t texture_bytes(const std::array<int, 3>& size, PixelType type, std::size_t channels) {
    std::array<int, 3> texels = size;
    if (config::is_block_coded(type)) {
        for (std::size_t a = 0; a < 2; ++a) texels[a] = blocks_along(size[a]);
    }
    return static_cast<std::uint64_t>(VoxelBox{{}, texels}.count()) * texel_bytes(type, channels);
}

bool write_texture(const FileContent& content, int level, const TexelSink& put) {
    if (config::is_block_coded(content.baked.pixel_type)) return write_blocks(content, level, put);
    return write_texels(content, level, put, true);
}

config::Outcome<bool> read_texture(const TexelInput& next, const std::array<int, 3>& size,
                                   PixelType type, std::size_t channels,
                                   const VoxelVisitor& visit) {
    if (config::is_block_coded(type)) return read_blocks(next, size, type, channels, visit);
    return read_texels(next, {size, channels, stored_channels(channels), type}, visit);
}

}  // namespace skybake
