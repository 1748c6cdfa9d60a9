// This header lists the formats of files, what each can hold, and the programs that read them.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

#include "config/sections/pixel_types.h"

namespace skybake::config {

enum class Compression { none, zip, zips, piz };

enum class FileFormat { exr, vdb, bin, png, dds, ktx2, nvdb, vol, npy, tga, usda, tif, f32, hdr };
enum class SheetLayout { stack, atlas };
enum class VdbCompression { none, zip, blosc };
enum class Ktx2Compression { none, zstd };

// The program that files are for (targets.h).
enum class Target {
    three,
    babylon,
    playcanvas,
    takram,
    godot,
    unity,
    unreal,
    bevy,
    blender,
    houdini,
    omniverse,
    mitsuba,
    pbrt,
    cosmoscout,
    stellarium,
    none,
};

// These facts say what files of a format can hold. The code of a format adds further facts
// (bakers/io/formats).
struct FormatFacts {
    FileFormat format;
    std::string_view name;         // used in recipes and as the end of a file's name
    std::string_view description;  // helps a user to choose
    PixelTypes pixel_types;
    bool is_image = false;        // holds the slices of a volume in one image
    bool only_volumes = false;    // it cannot hold tables
    bool only_colors = false;     // it holds tables of the colours of light in three channels
    bool has_all_levels = false;  // one file holds all levels of detail
    bool deflates = false;        // always deflates; EXR and VDB follow their `compression`
    bool only_refers = false;     // has no texels: it names the asset's VDB files

    constexpr bool holds(PixelType type) const { return pixel_types.contains(type); }
};

inline constexpr std::array file_formats = {
    FormatFacts{.format = FileFormat::exr,
                .name = "exr",
                .description = "OpenEXR, slices in one image; float or half",
                .pixel_types = floating_types,
                .is_image = true},
    FormatFacts{.format = FileFormat::vdb,
                .name = "vdb",
                .description = "OpenVDB, a grid per channel; float or half",
                .pixel_types = floating_types,
                .only_volumes = true},
    FormatFacts{.format = FileFormat::bin,
                .name = "bin",
                .description = "texels alone, little-endian, x fastest; any type of numbers",
                .pixel_types = number_types},
    FormatFacts{.format = FileFormat::png,
                .name = "png",
                .description = "PNG, slices in one image; unorm8 or unorm16",
                .pixel_types = unorm_types,
                .is_image = true,
                .deflates = true},
    FormatFacts{
        .format = FileFormat::dds,
        .name = "dds",
        .description =
            "DirectDraw Surface with all mips, a texture as GPUs load it; numbers or blocks",
        .pixel_types = texture_types,
        .has_all_levels = true},
    FormatFacts{
        .format = FileFormat::ktx2,
        .name = "ktx2",
        .description = "Khronos texture with all mips and its description; numbers or blocks",
        .pixel_types = texture_types,
        .has_all_levels = true},
    FormatFacts{.format = FileFormat::nvdb,
                .name = "nvdb",
                .description = "NanoVDB, a grid per channel; float or half",
                .pixel_types = floating_types,
                .only_volumes = true},
    FormatFacts{.format = FileFormat::vol,
                .name = "vol",
                .description = "Mitsuba's grid volume of floats; float or half",
                .pixel_types = floating_types,
                .only_volumes = true},
    FormatFacts{.format = FileFormat::npy,
                .name = "npy",
                .description = "NumPy's array, of shape z, y, x, channel (y, x, channel of "
                               "tables); any type of numbers",
                .pixel_types = number_types},
    FormatFacts{.format = FileFormat::tga,
                .name = "tga",
                .description = "Targa without compression, slices in one image; unorm8",
                .pixel_types = PixelTypes(PixelType::unorm8),
                .is_image = true},
    FormatFacts{.format = FileFormat::usda,
                .name = "usda",
                .description = "USD scene that refers to the asset's VDB files, which it needs",
                .pixel_types = all_types,
                .only_volumes = true,
                .only_refers = true},
    FormatFacts{.format = FileFormat::tif,
                .name = "tif",
                .description = "TIFF without compression, a page per slice; float",
                .pixel_types = PixelTypes(PixelType::float32)},
    FormatFacts{.format = FileFormat::f32,
                .name = "f32",
                .description = "texture of CalcMySky and Stellarium, four floats per texel",
                .pixel_types = PixelTypes(PixelType::float32)},
    FormatFacts{.format = FileFormat::hdr,
                .name = "hdr",
                .description = "Radiance picture of a sky, in three channels; rgbe",
                .pixel_types = PixelTypes(PixelType::rgbe),
                .is_image = true,
                .only_colors = true},
};

constexpr const FormatFacts& facts_of(FileFormat format) {
    return *std::find_if(file_formats.begin(), file_formats.end(),
                         [format](const FormatFacts& facts) { return facts.format == format; });
}

// Returns how many files of a format hold an asset of so many levels.
constexpr int files_of_levels(FileFormat format, int levels) {
    const FormatFacts& facts = facts_of(format);
    return facts.has_all_levels || facts.only_refers ? 1 : levels;
}

}  // namespace skybake::config
