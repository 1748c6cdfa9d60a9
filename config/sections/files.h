// What the files of assets are like.
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

// What files of a format can hold. Further facts are those of its code (bakers/io/formats).
struct FormatFacts {
    FileFormat format;
    std::string_view name;            // in recipes, and the end of a file's name
    std::string_view description;     // for those who choose
    std::array<bool, 4> pixel_types;  // in the order of PixelType
    bool is_image = false;            // volumes lie in it slice by slice
    bool only_volumes = false;        // and no tables
    bool has_all_levels = false;      // in one file
    bool deflates = false;            // always; EXR and VDB do what their `compression` says

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

// What the files of an asset are like.
struct AssetFiles {
    std::vector<FileFormat> formats = {FileFormat::exr};  // without duplicates
    PixelType pixel_type = PixelType::float32;
    SheetLayout layout = SheetLayout::stack;     // of images
    int columns = 0;                             // of an atlas; 0: chosen
    bool flip = false;                           // images: the last row is stored first
    int mips = 1;                                // levels, the asset itself among them
    Compression compression = Compression::zip;  // of EXR
    VdbCompression vdb_compression = VdbCompression::blosc;
};

// How the slices of a volume are laid out in the cells of an image.

// The most rows and columns of an image that engines import: Direct3D 11 and 12, Vulkan on common
// GPUs, Unity, Unreal and Godot take 16384, and Godot 3 aborts the import beyond.
inline constexpr int largest_image_edge = 16384;

// A row of cells is made whole: a longer one would take memory that grows with it.
inline constexpr std::int64_t widest_sheet = std::int64_t{1} << 20;

struct SliceSheet {
    int columns = 1;  // of cells
    int rows = 1;
};

// The sheet of a volume of `size` voxels. A stack has one column. An atlas has `columns`, or where
// that is 0:
//
//   the divisor of the number of slices that comes nearest to a square image, so that no cell is
//   empty: engines take the number of slices to be columns times rows;
//   where that image has an edge above largest_image_edge (a prime number of slices is one long
//   row or column), the fewest columns that make the image at least as wide as it is high, if this
//   one fits;
//   where neither fits, the divisor, unless its image is wider than widest_sheet.
//
// Of two images as near to a square the wider one is taken.
SliceSheet slice_sheet(const std::array<int, 3>& size, SheetLayout layout, int columns);

// Width and height of the image.
std::array<std::int64_t, 2> sheet_size(const std::array<int, 3>& size, const SliceSheet& sheet);

}  // namespace skybake::config
