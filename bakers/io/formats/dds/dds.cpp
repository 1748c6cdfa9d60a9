// Assets as DDS files: textures as GPUs hold them, with all levels of detail in one file.
//
// The header is that of DX10, but for 2-D textures and cubes of half and float, whose old formats readers
// without DX10 know too. A table is a 2-D texture, a volume a 3-D texture, and a table of the
// faces of a cube a cube texture: +x, -x, +y, -y, +z, -z, in a left-handed system whose y points up
// and whose z points ahead, each face with its upper row first and followed by its levels. A volume of layers is an array of 2-D
// textures, each followed by its levels. Channels
// are R, RG or RGBA of unorm8, unorm16, half or float; three channels are stored as four, the
// fourth of which is 1; or blocks of BC4, BC5 or BC6H, slice by slice. Texels of other textures are
// stored level after level, x fastest, then y, then z. Alpha is a number like the others, and the
// header says so (DDS_ALPHA_MODE_CUSTOM). The format has no place for metadata; the manifest says
// what the file means.
//
// Source: Microsoft, "DDS_HEADER structure", "D3DFORMAT" and "DDS_HEADER_DXT10 structure".
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bakers/field/baked.h"
#include "bakers/field/stored_voxels.h"
#include "bakers/io/files/file_io.h"
#include "bakers/io/formats/format.h"
#include "bakers/io/formats/texture.h"

namespace skybake {
namespace {

namespace fs = std::filesystem;

static_assert(std::endian::native == std::endian::little,
              "headers are stored as they lie in memory");

constexpr std::uint32_t four_characters_dx10 = 0x30315844;

// The members of DDS_PIXELFORMAT, DDS_HEADER and DDS_HEADER_DXT10 in their order, each 32 bits. Files
// have the last five only with the four characters of DX10.
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
    std::uint32_t four_characters = four_characters_dx10;
    std::array<std::uint32_t, 5> masks{};  // of formats without four characters
    std::uint32_t capabilities = 0;
    std::uint32_t capabilities_2 = 0;
    std::array<std::uint32_t, 3> unused{};
    std::uint32_t dxgi_format = 0;
    std::uint32_t dimension = 0;
    std::uint32_t miscellaneous = 0;
    std::uint32_t array_size = 1;
    std::uint32_t alpha_mode = 0;

    bool is_dx10() const { return four_characters == four_characters_dx10; }
    std::size_t bytes() const { return is_dx10() ? 148 : 128; }
};
static_assert(sizeof(Header) == 148);

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
constexpr std::uint32_t is_cube_of_six_faces = 0xFE00;
constexpr std::uint32_t is_texture_cube = 0x4;  // of `miscellaneous`
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

// D3DFORMAT values, which readers older than DX10 take for the four characters of 2-D textures and cubes.
constexpr std::array<TexelCodes, 2> d3d = {{
    {PixelType::float32, {114, 115, 116}},
    {PixelType::half, {111, 112, 113}},
}};

Header header_of(const Baked& baked) {
    const TextureExtent extent =
        texture_extent(baked.levels.front().size, !baked.is_table(), texture_parts(baked));
    const std::size_t channels = baked.channel_names.size();
    Header header;
    const bool is_coded = config::is_block_coded(baked.pixel_type);
    header.flags =
        has_caps_height_width_format | (is_coded ? has_slice_bytes : has_pitch) | has_mip_count;
    header.width = extent.width;
    header.height = extent.height;
    const int rows = is_coded ? static_cast<int>(extent.height) : 1;
    header.pitch = static_cast<std::uint32_t>(
        texture_bytes({static_cast<int>(extent.width), rows, 1}, baked.pixel_type, channels));
    header.levels = static_cast<std::uint32_t>(baked.levels.size());
    header.format_flags = has_four_characters;
    header.capabilities = is_texture;
    if (header.levels > 1) header.capabilities |= is_complex | is_mip_map;
    if (extent.depth > 0) {
        header.flags |= has_depth;
        header.depth = extent.depth;
        header.capabilities |= is_complex;
        header.capabilities_2 = is_volume;
    }
    if (extent.faces > 1) {
        header.capabilities |= is_complex;
        header.capabilities_2 = is_cube_of_six_faces;
        header.miscellaneous = is_texture_cube;
    }
    if (extent.layers > 0) {
        header.capabilities |= is_complex;
        header.array_size = extent.layers;
    }
    header.dxgi_format = texel_code(dxgi, baked.pixel_type, channels);
    header.dimension = extent.depth == 0 ? texture_2d : texture_3d;
    header.alpha_mode = channels == 4 ? alpha_is_custom : alpha_is_opaque;
    const std::uint32_t old_format = texel_code(d3d, baked.pixel_type, channels);
    const bool is_old_texture = extent.depth == 0 && extent.layers == 0;
    if (is_old_texture && old_format != 0) header.four_characters = old_format;
    return header;
}

// Where a level lies: a part of it in each face or layer, whose levels lie one after the other.
struct FacePlaces {
    std::uint64_t first = 0;       // of the level's part in the first face
    std::uint64_t part = 0;        // bytes of the level in a face
    std::uint64_t face = 0;        // bytes of all levels in a face
    std::array<int, 3> size = {};  // texels of the level, of all faces or layers

    // Returns where byte `at` of the level lies, and how many bytes lie there one after the other.
    std::pair<std::uint64_t, std::uint64_t> place(std::uint64_t at) const {
        return {first + at / part * face + at % part, part - at % part};
    }
};

// How many faces or layers lie one after the other, with all their levels.
std::uint32_t parts_of(const TextureExtent& extent) {
    return extent.layers > 0 ? extent.layers : extent.faces;
}

// Returns the places of all levels of a texture behind its header.
std::vector<FacePlaces> face_places(const FileShape& shape, const Header& header) {
    const std::uint32_t parts = parts_of(texture_extent(shape.size, false, shape.parts));
    std::vector<FacePlaces> places;
    std::uint64_t bytes = 0;
    std::array<int, 3> size = shape.size;
    for (int i = 0; i < shape.levels; ++i, size = next_texture_size(size, shape.parts)) {
        const std::uint64_t part = texture_bytes(size, shape.pixel_type, shape.channels) / parts;
        places.push_back({header.bytes() + bytes, part, 0, size});
        bytes += part;
    }
    for (FacePlaces& level : places) level.face = bytes;
    return places;
}

TexelSink face_sink(FileOutput& output, const FacePlaces& places) {
    return [&output, places, at = std::uint64_t{0}](std::string_view bytes) mutable {
        while (!bytes.empty()) {
            const auto [place, most] = places.place(at);
            const std::string_view piece = bytes.substr(0, most);
            if (output.position() != place) output.seek(place);
            output.write(piece);
            at += piece.size();
            bytes.remove_prefix(piece.size());
        }
        return output.error() == 0;
    };
}

TexelInput face_input(FileInput& file, const FacePlaces& places) {
    return [&file, places, at = std::uint64_t{0}](
               char* bytes, std::size_t count) mutable -> std::optional<config::Diagnostic> {
        while (count > 0) {
            const auto [place, most] = places.place(at);
            const std::size_t piece = std::min<std::uint64_t>(count, most);
            if (auto problem = texel_input(file, place)(bytes, piece)) return problem;
            at += piece;
            bytes += piece;
            count -= piece;
        }
        return std::nullopt;
    };
}

Outcome<bool> write_dds_file(const FileContent& content, const fs::path& path) {
    if (const auto reason = texture_obstacle(content.baked, "DDS")) {
        return contradiction(path, *reason);
    }
    FileOutput output(path);
    const Header header = header_of(content.baked);
    output.write({reinterpret_cast<const char*>(&header), header.bytes()});
    const Baked& baked = content.baked;
    const std::vector<FacePlaces> places =
        face_places({.size = baked.levels.front().size,
                     .channels = baked.channel_names.size(),
                     .pixel_type = baked.pixel_type,
                     .grid = {},
                     .levels = static_cast<int>(baked.levels.size()),
                     .parts = texture_parts(baked)},
                    header);
    bool complete = true;
    for (std::size_t level = 0; complete && level < places.size(); ++level) {
        complete =
            write_texture(content, static_cast<int>(level), face_sink(output, places[level]));
    }
    return output.finished(complete);
}

// Returns what a header contains that skybake does not write, in words, or nothing.
std::optional<std::string> strange(const Header& header) {
    const Header plain;
    if (header.magic != plain.magic) return "it does not begin with `DDS `";
    const bool is_known = header.is_dx10() || texel_kind(d3d, header.four_characters);
    if (header.size != plain.size || header.format_size != plain.format_size || !is_known) {
        return "it has neither the header of DX10 nor the format of floats or halves";
    }
    const bool is_cube = (header.miscellaneous & is_texture_cube) != 0;
    const bool may_be_array = header.dimension == texture_2d && !is_cube;
    if (header.array_size != 1 && !may_be_array) return "it is an array of cubes or of volumes";
    if (is_cube != (header.capabilities_2 == is_cube_of_six_faces)) {
        return "its headers disagree on whether it is a cube of six faces";
    }
    return std::nullopt;
}

Outcome<Header> read_header(FileInput& file) {
    Header header;
    const auto done = file.read(0, reinterpret_cast<char*>(&header), sizeof header);
    if (!done) return file.diagnostic();
    if (*done < header.bytes())
        return damaged_file(file.path(), "DDS", "it ends within its header");
    if (const auto kind = texel_kind(d3d, header.four_characters)) {  // what DX10 would say
        header.dxgi_format = texel_code(dxgi, kind->type, kind->channels);
        header.dimension = texture_2d;
        header.miscellaneous = header.capabilities_2 == is_cube_of_six_faces ? is_texture_cube : 0;
        header.array_size = 1;
    }
    if (const auto reason = strange(header)) return damaged_file(file.path(), "DDS", *reason);
    return {header, {}};
}

Outcome<FileFacts> inspect_dds(FileInput& file) {
    const Outcome<Header> header = read_header(file);
    if (!header.value) return {{}, header.diagnostics};
    FileFacts facts;
    const auto kind = texel_kind(dxgi, header.value->dxgi_format);
    if (!kind) {
        return damaged_file(file.path(), "DDS",
                            fmt::format("its DXGI format is {}", header.value->dxgi_format));
    }
    facts.pixel_type = kind->type;
    facts.channels = kind->channels;
    return {std::move(facts), {}};
}

// A texture by itself is also an array of one.
TextureExtent extent_of(const Header& header, TextureParts parts) {
    const bool is_array = parts == TextureParts::layers || header.array_size != 1;
    return {header.width, header.height, header.dimension == texture_3d ? header.depth : 0,
            header.miscellaneous == is_texture_cube ? 6U : 1U, is_array ? header.array_size : 0};
}

// Whether the header is that of a file of this shape.
bool fits(const Header& header, const FileShape& shape) {
    const bool has_depth_of_one = header.dimension == texture_3d;
    const TextureExtent extent =
        texture_extent(shape.size, has_depth_of_one || shape.size[2] != 1, shape.parts);
    return has_square_faces(shape.size, shape.levels, shape.parts) &&
           extent_of(header, shape.parts) == extent &&
           header.levels == static_cast<std::uint32_t>(shape.levels) &&
           header.dxgi_format == texel_code(dxgi, shape.pixel_type, shape.channels);
}

Outcome<bool> read_dds_file(FileInput& file, const FileShape& shape, int level,
                            const VoxelVisitor& visit) {
    const Outcome<Header> header = read_header(file);
    if (!header.value) return {{}, header.diagnostics};
    if (!fits(*header.value, shape)) return other_size(file.path());
    const FacePlaces wanted = face_places(shape, *header.value)[static_cast<std::size_t>(level)];
    const std::uint64_t bytes = wanted.face * parts_of(extent_of(*header.value, shape.parts));
    if (file.size() != header.value->bytes() + bytes) return other_size(file.path());
    return read_texture(face_input(file, wanted), wanted.size, shape.pixel_type, shape.channels,
                        visit);
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
