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
    std::uint32_t pitch = 0;  // bytes per row of level 0
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

// The DXGI_FORMAT values of a pixel type for one, two and four channels.
struct Dxgi {
    PixelType type;
    std::array<std::uint32_t, 3> formats;
};
constexpr std::array<Dxgi, 4> dxgi = {{
    {PixelType::float32, {41, 16, 2}},
    {PixelType::half, {54, 34, 10}},
    {PixelType::unorm8, {61, 49, 28}},
    {PixelType::unorm16, {56, 35, 11}},
}};
constexpr std::array<std::size_t, 3> stored_channels = {1, 2, 4};

std::size_t stored_for(std::size_t channels) { return channels == 3 ? 4 : channels; }

std::uint32_t dxgi_format_of(PixelType type, std::size_t channels) {
    const auto row = std::find_if(dxgi.begin(), dxgi.end(),
                                  [type](const Dxgi& entry) { return entry.type == type; });
    const auto column =
        std::find(stored_channels.begin(), stored_channels.end(), stored_for(channels));
    return row->formats[static_cast<std::size_t>(column - stored_channels.begin())];
}

Header header_of(const Baked& baked) {
    const std::array<int, 3>& size = baked.levels.front().size;
    const bool flat = baked.is_table();
    const std::size_t channels = baked.channel_names.size();
    Header header;
    header.flags = has_caps_height_width_format | has_pitch | has_mip_count;
    header.width = static_cast<std::uint32_t>(size[0]);
    header.height = static_cast<std::uint32_t>(size[1]);
    header.pitch = header.width * static_cast<std::uint32_t>(stored_for(channels)) *
                   static_cast<std::uint32_t>(bytes_per_value(baked.pixel_type));
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
    header.dxgi_format = dxgi_format_of(baked.pixel_type, channels);
    header.dimension = flat ? texture_2d : texture_3d;
    header.alpha_mode = channels == 4 ? alpha_is_custom : alpha_is_opaque;
    return header;
}

// Returns what DDS files cannot hold of the asset, in words, or nothing.
std::optional<std::string> dds_obstacle(const Baked& baked) {
    if (baked.channel_names.size() > 4) return "DDS files hold at most four channels";
    for (std::size_t i = 1; i < baked.levels.size(); ++i) {
        if (baked.levels[i].size != next_mip_size(baked.levels[i - 1].size)) {
            return "each level of a DDS file has half the size of the one before, rounded down";
        }
    }
    return std::nullopt;
}

Outcome<bool> write_dds_file(const FileContent& content, const fs::path& path) {
    if (const auto reason = dds_obstacle(content.baked))
        return {{}, {contradiction(path, *reason)}};
    FileOutput output(path);
    const Header header = header_of(content.baked);
    output.write({reinterpret_cast<const char*>(&header), header_bytes});
    bool complete = true;
    for (int level = 0; complete && level < static_cast<int>(content.baked.levels.size());
         ++level) {
        complete = write_texels(content, level, TexelPadding::three_to_four, output);
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
    for (const Dxgi& row : dxgi) {
        for (std::size_t i = 0; i < row.formats.size(); ++i) {
            if (row.formats[i] != header.value->dxgi_format) continue;
            facts.pixel_type = row.type;
            facts.channels = stored_channels[i];
        }
    }
    if (!facts.pixel_type) {
        return {{},
                {damaged_dds_file(
                    path, fmt::format("its DXGI format is {}", header.value->dxgi_format))}};
    }
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
           header.dxgi_format == dxgi_format_of(shape.pixel_type, shape.channels);
}

Outcome<bool> read_dds_file(const fs::path& path, const FileShape& shape, int level,
                            const VoxelVisitor& visit) {
    Outcome<FileInput> file = FileInput::open(path);
    if (!file.value) return {{}, std::move(file.diagnostics)};
    const Outcome<Header> header = read_header(*file.value, path);
    if (!header.value) return {{}, header.diagnostics};
    if (!fits(*header.value, shape)) return {{}, {other_size(path)}};
    StoredTexelRange range = {header_bytes, shape.size, shape.channels, stored_for(shape.channels),
                              shape.pixel_type};
    StoredTexelRange wanted = range;
    for (int i = 0; i < shape.levels; ++i) {
        if (i == level) wanted = range;
        range.offset += range.bytes();
        range.size = next_mip_size(range.size);
    }
    if (file.value->size() != range.offset) return {{}, {other_size(path)}};
    return read_texels(*file.value, wanted, visit);
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
