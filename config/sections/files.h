// This header says what the files of assets are like: formats, pixel types and compression, and the
// layout of a volume's slices in an image.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace skybake::config {

enum class PixelType { float32, half, unorm8, unorm16 };
enum class Compression { none, zip, zips, piz };

enum class FileFormat { exr, vdb, bin, png, dds };
enum class SheetLayout { stack, atlas };
enum class VdbCompression { none, zip, blosc };

// These facts say what files of a format can hold. The code of a format adds further facts
// (bakers/io/formats).
struct FormatFacts {
    FileFormat format;
    std::string_view name;            // used in recipes and as the end of a file's name
    std::string_view description;     // helps a user to choose
    std::array<bool, 4> pixel_types;  // in the order of PixelType
    bool is_image = false;            // holds the slices of a volume in one image
    bool only_volumes = false;        // it cannot hold tables
    bool has_all_levels = false;      // one file holds all levels of detail
    bool deflates = false;            // always deflates; EXR and VDB follow their `compression`

    constexpr bool holds(PixelType type) const {
        return pixel_types[static_cast<std::size_t>(type)];
    }
};

inline constexpr std::array file_formats = {
    FormatFacts{FileFormat::exr,
                "exr",
                "OpenEXR, slices in one image; float or half",
                {true, true, false, false},
                true},
    FormatFacts{FileFormat::vdb,
                "vdb",
                "OpenVDB, a grid per channel; float or half",
                {true, true, false, false},
                false,
                true},
    FormatFacts{FileFormat::bin,
                "bin",
                "texels alone, little-endian, x fastest; any pixel type",
                {true, true, true, true}},
    FormatFacts{FileFormat::png,
                "png",
                "PNG, slices in one image; unorm8 or unorm16",
                {false, false, true, true},
                true,
                false,
                false,
                true},
    FormatFacts{FileFormat::dds,
                "dds",
                "DirectDraw Surface with all mips, a texture as GPUs load it; any pixel type",
                {true, true, true, true},
                false,
                false,
                true},
};

constexpr const FormatFacts& facts_of(FileFormat format) {
    return *std::find_if(file_formats.begin(), file_formats.end(),
                         [format](const FormatFacts& facts) { return facts.format == format; });
}

// These keys say what the files of one asset are like.
struct AssetFiles {
    std::vector<FileFormat> formats = {FileFormat::exr};  // without duplicates
    PixelType pixel_type = PixelType::float32;
    SheetLayout layout = SheetLayout::stack;     // for images
    int columns = 0;                             // for an atlas; 0: chosen by slice_sheet
    bool flip = false;                           // for images: the last row is stored first
    int mips = 1;                                // levels of detail, including the asset itself
    Compression compression = Compression::zip;  // for EXR
    VdbCompression vdb_compression = VdbCompression::blosc;
};

// The rest of this header is about the cells of an image in which the slices of a volume are laid
// out.

// Engines import images of at most this many rows and columns. Direct3D 11 and 12, Vulkan on common
// GPUs, Unity, Unreal and Godot take 16384, and Godot 3 aborts the import beyond that.
inline constexpr int largest_image_edge = 16384;

// An image is at most this many pixels wide. A whole row of cells is held in memory, so a wider
// image would take memory that grows with its width.
inline constexpr std::int64_t widest_sheet = std::int64_t{1} << 20;

struct SliceSheet {
    int columns = 1;  // of cells
    int rows = 1;
};

// Returns the sheet of a volume of `size` voxels. A stack has one column. An atlas has `columns`
// columns. If `columns` is 0, the number is chosen as follows:
//
//   - It is the divisor of the number of slices that comes nearest to a square image. Then no cell
//     is empty, and engines expect that: they take the number of slices to be columns times rows.
//   - If that image has an edge above largest_image_edge, it is the fewest columns that make the
//     image at least as wide as it is high, if that image fits. This happens for a prime number of
//     slices, whose only divisors give one long row or column.
//   - If neither image fits, it is the divisor again, or the fewest columns if the image of the
//     divisor is wider than widest_sheet.
//
// If two images are equally near to a square, the wider one is taken.
SliceSheet slice_sheet(const std::array<int, 3>& size, SheetLayout layout, int columns);

// Returns the width and height of the image in pixels.
std::array<std::int64_t, 2> sheet_size(const std::array<int, 3>& size, const SliceSheet& sheet);

}  // namespace skybake::config
