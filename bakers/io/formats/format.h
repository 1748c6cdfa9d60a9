// What the program can do with files of a format: one row a format, in format.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/field/baked.h"
#include "bakers/io/files/file_io.h"
#include "bakers/io/formats/sheet.h"
#include "bakers/math/bake_options.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/files.h"

namespace skybake {

// A file that is to be written: a level of an asset which has been surveyed, or all of its levels.
struct FileContent {
    const Baked& baked;
    int level = 0;         // or the first of all
    std::string metadata;  // what the file says of itself, JSON (metadata.h)
    int threads = 1;
    Progress* progress = nullptr;
};

// A file that is to be read, and what its manifest says of it.
struct FileShape {
    std::array<int, 3> size{};  // of level 0
    std::size_t channels = 0;
    config::PixelType pixel_type = config::PixelType::float32;
    SheetGrid grid;  // of images
    int levels = 1;  // in this file
};

// What a file says of itself. Members are empty where files of the format do not say it.
struct FileFacts {
    std::optional<config::PixelType> pixel_type;
    std::vector<std::string> names;  // of channels, or of the grid of each
    std::size_t channels = 0;        // how many, where they have no names
    std::string compression;
    std::array<std::int64_t, 2> image_size{};  // width, height
    std::string metadata;                      // as in FileContent
};

struct Format {
    config::FileFormat format;
    bool has_metadata = true;

    // Writes a file over an existing one. True when it is complete, false once
    // progress->cancelled(). E0301 with the system's reason; E0500 where the format cannot hold
    // what is asked for, a mistake of the program.
    config::Outcome<bool> (*write)(const FileContent& content, const std::filesystem::path& path);

    // E0300, E0304; null where files of the format say nothing.
    config::Outcome<FileFacts> (*inspect)(const std::filesystem::path& path);

    // Hands all voxels of a level of the file to `visit`, piece after piece. False once visit
    // returned false. E0300; E0304 where the file is damaged or not of this shape.
    config::Outcome<bool> (*read)(const std::filesystem::path& path, const FileShape& shape,
                                  int level, const VoxelVisitor& visit);

    // The compression of an asset's files, in its word; null: "none".
    std::string_view (*compression)(const config::AssetFiles& files) = nullptr;

    // The names of the grids of an asset's channels; null: it has none.
    std::vector<std::string> (*grids)(const Baked& baked) = nullptr;

    // What keeps files of the format from being written here; null: nothing. Ask before a long
    // bake. E0301.
    std::optional<config::Diagnostic> (*obstacle)(const std::filesystem::path& path) = nullptr;
};

// In the order of config::file_formats.
std::span<const Format> formats();

const Format& format_of(config::FileFormat format);

// By its word in recipes and manifests; null: none.
const Format* find_format(std::string_view word);

// E0304: the file is not of the size that its manifest says.
config::Diagnostic other_size(const std::filesystem::path& path);

// E0500.
config::Diagnostic contradiction(const std::filesystem::path& path, const std::string& what);

// Under which name files carry what they say of themselves: an attribute of EXR and VDB files, a
// text of PNG files.
inline constexpr const char* metadata_name = "skybake/asset";

// Texels as they lie in memory, one after the other: what files without compression hold.
enum class TexelPadding {
    none,
    three_to_four,  // three channels are stored as four, the fourth of which is 1
};

// Appends the texels of a level in the order x, y, z, channels interleaved, made in parallel. False
// once progress->cancelled(); errors are the output's.
bool write_texels(const FileContent& content, int level, TexelPadding padding, FileOutput& output);

// Where the texels of a level stand in a file.
struct StoredTexelRange {
    std::uint64_t offset = 0;
    std::array<int, 3> size{};
    std::size_t channels = 0;         // that are asked for, the first
    std::size_t stored_channels = 0;  // in the file
    config::PixelType type = config::PixelType::float32;

    std::uint64_t bytes() const;
};

// As Format::read. E0300 where the file ends early.
config::Outcome<bool> read_texels(FileInput& file, const StoredTexelRange& range,
                                  const VoxelVisitor& visit);

}  // namespace skybake
