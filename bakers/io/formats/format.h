// The program's abilities with the files of each format. The table in format.cpp has one row per
// format.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/io/files/file_io.h"
#include "bakers/io/formats/sheet.h"
#include "bakers/math/bake_options.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/forward.h"
#include "config/sections/pixel_types.h"

namespace skybake {

struct Baked;

// The content of a file that is to be written: one level of an asset, or all its levels. They have
// been surveyed.
struct FileContent {
    const Baked& baked;
    int level = 0;         // the level, or the first of all levels
    std::string metadata;  // what the file says of itself, as JSON (metadata.h)
    int threads = 1;
    Progress* progress = nullptr;
};

// The texture that an asset's slices make together. The faces of a cube lie below each other in an
// image, in the order +x, -x, +y, -y, +z, -z and the orientation that GPUs have. The layers of an array
// of 2-D textures are the slices of a volume.
enum class TextureParts { none, cube, layers };

// The manifest's facts about a file that is to be read.
struct FileShape {
    std::array<int, 3> size{};  // of level 0
    std::size_t channels = 0;
    config::PixelType pixel_type = config::PixelType::float32;
    SheetGrid grid;  // of images
    int levels = 1;  // number of levels in this file
    TextureParts parts = TextureParts::none;
};

// The facts that a file states. A member is empty if files of the format do not say it.
struct FileFacts {
    std::optional<config::PixelType> pixel_type;
    std::vector<std::string> names;  // of channels, or of the grid of each
    std::size_t channels = 0;        // their number, if they have no names
    std::string compression;
    std::array<std::int64_t, 2> image_size{};  // width, height
    std::string metadata;                      // as in FileContent
};

struct Format {
    config::FileFormat format;
    bool has_metadata = true;

    // Writes a file over an existing one. Returns true when it is complete, false once
    // progress->cancelled(). E0301 has the system's reason; E0500 means a bug: the format cannot
    // hold what is asked for.
    config::Outcome<bool> (*write)(const FileContent& content, const std::filesystem::path& path);

    // Reads what a file says of itself; null if files of the format say nothing. E0300, E0304.
    config::Outcome<FileFacts> (*inspect)(FileInput& file);

    // Passes all voxels of a level of the file to `visit`, piece after piece. Returns false once
    // visit has returned false. E0300 if the file cannot be read; E0304 if it is damaged or not of
    // this shape. Null if files of the format have no voxels.
    config::Outcome<bool> (*read)(FileInput& file, const FileShape& shape, int level,
                                  const VoxelVisitor& visit);

    // Returns the word for the compression of an asset's files; null: "none".
    std::string_view (*compression)(const config::AssetFiles& files) = nullptr;

    // Returns the names of the grids of an asset's channels; null: files have no grids.
    std::vector<std::string> (*grids)(const Baked& baked) = nullptr;

    // Returns what prevents files of the format from being written on this machine; null: nothing
    // does. Call it before a long bake. E0301.
    std::optional<config::Diagnostic> (*obstacle)(const std::filesystem::path& path) = nullptr;
};

// Each format has a folder here, where the head of NAME.cpp or of a header says what its files hold.
Format exr_format();
Format vdb_format();
Format bin_format();
Format png_format();
Format dds_format();
Format ktx2_format();
Format nvdb_format();
Format vol_format();
Format npy_format();
Format tga_format();
Format usda_format();
Format tif_format();
Format f32_format();
Format hdr_format();

// Returns all formats in the order of config::file_formats.
std::span<const Format> formats();

const Format& format_of(config::FileFormat format);

// Finds a format by its word in recipes and manifests; null if there is none.
const Format* find_format(std::string_view word);

// Returns bytes of a file, or nothing if it does not have them.
std::optional<std::string> file_part(FileInput& file, std::uint64_t offset, std::size_t count);

// Returns E0304: the file is none of a format, "PNG", that skybake reads.
config::Diagnostic damaged_file(const std::filesystem::path& path, const char* format,
                                const std::string& reason);

// Returns E0304: the file does not have the size that its manifest says.
config::Diagnostic other_size(const std::filesystem::path& path);

// Returns E0500: the file's content contradicts its format, which is a bug.
config::Diagnostic contradiction(const std::filesystem::path& path, const std::string& what);

// The name under which files carry what they say of themselves: an attribute in EXR and VDB files,
// a text in PNG files.
inline constexpr const char* metadata_name = "skybake/asset";

// Receives texels, piece after piece; the pieces are the same in every run. If it returns false,
// writing ends.
using TexelSink = std::function<bool(std::string_view bytes)>;

// Makes the texels of a level in parallel and passes them on in the order x, y, z, channels interleaved, as
// in memory. With `pads`, three channels are stored as four, the fourth of which is 1. Returns false once
// progress->cancelled().
bool write_texels(const FileContent& content, int level, const TexelSink& put, bool pads = false);

// Appends texels to a file, which keeps errors.
TexelSink texel_sink(FileOutput& output);

// The texels of a level as they follow each other in a file.
struct StoredTexelRange {
    std::array<int, 3> size{};
    std::size_t channels = 0;         // the first ones, which are asked for
    std::size_t stored_channels = 0;  // in the file
    config::PixelType type = config::PixelType::float32;

    std::uint64_t bytes() const;
};

// Reads the next bytes of stored texels, or says why they cannot be read.
using TexelInput = std::function<std::optional<config::Diagnostic>(char* bytes, std::size_t count)>;

// Reads the bytes of a file from `offset` on. E0300 if it ends early.
TexelInput texel_input(FileInput& file, std::uint64_t offset);

// Reads texels as Format::read does; diagnostics are those of `next`.
config::Outcome<bool> read_texels(const TexelInput& next, const StoredTexelRange& texels,
                                  const VoxelVisitor& visit);

}  // namespace skybake
