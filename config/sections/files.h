// What the files of assets are like.
#pragma once

#include <algorithm>
#include <array>
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

}  // namespace skybake::config
