#include "bakers/io/formats/dds/dds.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <optional>
#include <string>

#include "bakers/field/pixel_type.h"
#include "bakers/field/stored_voxels.h"
#include "bakers/io/files/file_io.h"
#include "bakers/io/formats/format.h"
#include "bakers/io/formats/texture.h"

namespace skybake {
namespace {

using config::Outcome;
using config::PixelType;
namespace fs = std::filesystem;

static_assert(std::endian::native == std::endian::little,
              "headers are stored as they lie in memory");

// The members of DDS_PIXELFORMAT, DDS_HEADER and DDS_HEADER_DXT10 in their order, each 32 bits.
struct Header {
    std::array<char, 4> magic = {'D', 'D', 'S', ' '};
    std::uint32_t size = 124;
    std::uint32_t flags = 0;
    std::uint32_t height = 0;
    std::uint32_t width = 0;
    std::uint32_t pitch = 0;  // bytes per row of level 0, or per slice of blocks
    std::uint32_t depth = 0;
    std::uint32_t levels = 0;
    std::array<std::uint32_t, 11> reserved{};
    std::uint32_t format_size = 32;
    std::uint32_t format_flags = 0;
    std::array<char, 4> four_characters = {'D', 'X', '1', '0'};
    std::array<std::uint32_t, 5> masks{};  // for formats without the DX10 header
    std::uint32_t capabilities = 0;
    std::uint32_t capabilities_2 = 0;
    std::array<std::uint32_t, 3> unused{};
    std::uint32_t dxgi_format = 0;
    std::uint32_t dimension = 0;
    std::uint32_t miscellaneous = 0;
    std::uint32_t array_size = 1;
    std::uint32_t alpha_mode = 0;
};
constexpr std::size_t header_bytes = 148;
static_assert(sizeof(Header) == header_bytes);

constexpr std::uint32_t has_caps_height_width_format = 0x1007;
constexpr std::uint32_t has_pitch = 0x8;
constexpr std::uint32_t has_slice_bytes = 0x80000;
constexpr std::uint32_t has_mip_count = 0x20000;
constexpr std::uint32_t has_depth = 0x800000;
constexpr std::uint32_t has_four_characters = 0x4;
constexpr std::uint32_t is_texture = 0x1000;
constexpr std::uint32_t is_complex = 0x8;
constexpr std::uint32_t is_mip_map = 0x400000;
constexpr std::uint32_t is_volume = 0x200000;
constexpr std::uint32_t texture_2d = 3;
constexpr std::uint32_t texture_3d = 4;
constexpr std::uint32_t alpha_is_opaque = 3;
constexpr std::uint32_t alpha_is_custom = 4;

// DXGI_FORMAT values.
constexpr std::array<TexelCodes, 7> dxgi = {{
    {PixelType::float32, {41, 16, 2}},
    {PixelType::half, {54, 34, 10}},
    {PixelType::unorm8, {61, 49, 28}},
    {PixelType::unorm16, {56, 35, 11}},
    {PixelType::bc4, {80, 0, 0}},
    {PixelType::bc5, {0, 83, 0}},
    {PixelType::bc6h, {0, 0, 95}},
}};

Header header_of(const Baked& baked) {
    const std::array<int, 3>& size = baked.levels.front().size;
    const bool flat = baked.is_table();
    const std::size_t channels = baked.channel_names.size();
    Header header;
    const bool is_coded = config::is_block_coded(baked.pixel_type);
    header.flags =
        has_caps_height_width_format | (is_coded ? has_slice_bytes : has_pitch) | has_mip_count;
    header.width = static_cast<std::uint32_t>(size[0]);
    header.height = static_cast<std::uint32_t>(size[1]);
    header.pitch = static_cast<std::uint32_t>(
        texture_bytes({size[0], is_coded ? size[1] : 1, 1}, baked.pixel_type, channels));
    header.levels = static_cast<std::uint32_t>(baked.levels.size());
    header.format_flags = has_four_characters;
    header.capabilities = is_texture;
    if (header.levels > 1) header.capabilities |= is_complex | is_mip_map;
    if (!flat) {
        header.flags |= has_depth;
        header.depth = static_cast<std::uint32_t>(size[2]);
        header.capabilities |= is_complex;
        header.capabilities_2 = is_volume;
    }
    header.dxgi_format = texel_code(dxgi, baked.pixel_type, channels);
    header.dimension = flat ? texture_2d : texture_3d;
    header.alpha_mode = channels == 4 ? alpha_is_custom : alpha_is_opaque;
    return header;
}

Outcome<bool> write_dds_file(const FileContent& content, const fs::path& path) {
    if (const auto reason = texture_obstacle(content.baked, "DDS")) {
        return {{}, {contradiction(path, *reason)}};
    }
    FileOutput output(path);
    const Header header = header_of(content.baked);
    output.write({reinterpret_cast<const char*>(&header), header_bytes});
    bool complete = true;
    for (int level = 0; complete && level < static_cast<int>(content.baked.levels.size());
         ++level) {
        complete = write_texture(content, level, texel_sink(output));
    }
    if (!output.finish()) return {{}, {output.diagnostic()}};
    return {complete, {}};
}

config::Diagnostic damaged_dds_file(const fs::path& path, const std::string& reason) {
    return file_error(
        "E0304", path.string(),
        fmt::format("`{}` is no DDS file that skybake reads: {}", path.string(), reason));
}

// Returns what a header contains that skybake does not write, in words, or nothing.
std::optional<std::string> strange(const Header& header) {
    const Header plain;
    if (header.magic != plain.magic) return "it does not begin with `DDS `";
    const bool is_dx10 = header.size == plain.size && header.format_size == plain.format_size &&
                         header.four_characters == plain.four_characters;
    if (!is_dx10) return "it does not have the header of DX10";
    if (header.array_size != 1) return "it is an array of textures";
    return std::nullopt;
}

Outcome<Header> read_header(FileInput& file, const fs::path& path) {
    Header header;
    const auto done = file.read(0, reinterpret_cast<char*>(&header), header_bytes);
    if (!done) return {{}, {file.diagnostic()}};
    if (*done < header_bytes) return {{}, {damaged_dds_file(path, "it ends within its header")}};
    if (const auto reason = strange(header)) return {{}, {damaged_dds_file(path, *reason)}};
    return {header, {}};
}

Outcome<FileFacts> inspect_dds(const fs::path& path) {
    Outcome<FileInput> file = FileInput::open(path);
    if (!file.value) return {{}, std::move(file.diagnostics)};
    const Outcome<Header> header = read_header(*file.value, path);
    if (!header.value) return {{}, header.diagnostics};
    FileFacts facts;
    const auto kind = texel_kind(dxgi, header.value->dxgi_format);
    if (!kind) {
        return {{},
                {damaged_dds_file(
                    path, fmt::format("its DXGI format is {}", header.value->dxgi_format))}};
    }
    facts.pixel_type = kind->type;
    facts.channels = kind->channels;
    return {std::move(facts), {}};
}

// Whether the header is that of a file of this shape.
bool fits(const Header& header, const FileShape& shape) {
    const bool is_flat = header.dimension == texture_2d;
    const std::uint32_t depth = is_flat ? 1 : header.depth;
    return header.width == static_cast<std::uint32_t>(shape.size[0]) &&
           header.height == static_cast<std::uint32_t>(shape.size[1]) &&
           depth == static_cast<std::uint32_t>(shape.size[2]) &&
           header.levels == static_cast<std::uint32_t>(shape.levels) &&
           header.dxgi_format == texel_code(dxgi, shape.pixel_type, shape.channels);
}

Outcome<bool> read_dds_file(const fs::path& path, const FileShape& shape, int level,
                            const VoxelVisitor& visit) {
    Outcome<FileInput> file = FileInput::open(path);
    if (!file.value) return {{}, std::move(file.diagnostics)};
    const Outcome<Header> header = read_header(*file.value, path);
    if (!header.value) return {{}, header.diagnostics};
    if (!fits(*header.value, shape)) return {{}, {other_size(path)}};
    std::uint64_t offset = header_bytes;
    std::uint64_t wanted = 0;
    std::array<int, 3> size = shape.size;
    std::array<int, 3> wanted_size{};
    for (int i = 0; i < shape.levels; ++i, size = next_mip_size(size)) {
        if (i == level) {
            wanted = offset;
            wanted_size = size;
        }
        offset += texture_bytes(size, shape.pixel_type, shape.channels);
    }
    if (file.value->size() != offset) return {{}, {other_size(path)}};
    return read_texture(texel_input(*file.value, wanted), wanted_size, shape.pixel_type,
                        shape.channels, visit);
}

}  // namespace

Format dds_format() {
    return {.format = config::FileFormat::dds,
            .has_metadata = false,
            .write = write_dds_file,
            .inspect = inspect_dds,
            .read = read_dds_file};
}

}  // namespace skybake
