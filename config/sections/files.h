// This header says what the files of assets are like: formats, pixel types and compression, and the
// layout of a volume's slices in an image.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace skybake::config {

// Types up to unorm16 hold each number by itself. The others code blocks of texels: bc4, bc5 and bc6h are
// blocks of 4 x 4 texels that GPUs decode; fp8 and fp16 are leaves of NanoVDB grids.
// Recipes do not offer bc5, the last one, because no asset has two channels.
enum class PixelType { float32, half, unorm8, unorm16, bc4, bc6h, fp8, fp16, bc5 };
enum class Compression { none, zip, zips, piz };

enum class FileFormat { exr, vdb, bin, png, dds, ktx2, nvdb, vol, npy, tga, usda, tif, f32 };
enum class SheetLayout { stack, atlas };
enum class VdbCompression { none, zip, blosc };
enum class Ktx2Compression { none, zstd };

// The program that files are for (targets.h). Recipes do not offer none, the last one.
enum class Target {
    three,
    babylon,
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

constexpr bool is_block_coded(PixelType type) { return type >= PixelType::bc4; }

// Returns how many channels a type codes, or 0 if it takes any number.
constexpr std::size_t coded_channels(PixelType type) {
    if (type == PixelType::bc4) return 1;
    if (type == PixelType::bc5) return 2;
    return type == PixelType::bc6h ? 3 : 0;
}

constexpr bool is_leaf_coded(PixelType type) {
    return type == PixelType::fp8 || type == PixelType::fp16;
}

// A set of pixel types.
class PixelTypes {
  public:
    template <class... T>
    constexpr explicit PixelTypes(T... types) : bits_((0U | ... | bit(types))) {}
    constexpr bool contains(PixelType type) const { return (bits_ & bit(type)) != 0; }

  private:
    static constexpr unsigned bit(PixelType type) { return 1U << static_cast<unsigned>(type); }
    unsigned bits_;
};

inline constexpr PixelTypes floating_types(PixelType::float32, PixelType::half);
inline constexpr PixelTypes unorm_types(PixelType::unorm8, PixelType::unorm16);
inline constexpr PixelTypes number_types(PixelType::float32, PixelType::half, PixelType::unorm8,
                                         PixelType::unorm16);
inline constexpr PixelTypes texture_types(PixelType::float32, PixelType::half, PixelType::unorm8,
                                          PixelType::unorm16, PixelType::bc4, PixelType::bc5,
                                          PixelType::bc6h);
inline constexpr PixelTypes nanovdb_types(PixelType::float32, PixelType::half, PixelType::fp8,
                                          PixelType::fp16);
inline constexpr PixelTypes all_types(PixelType::float32, PixelType::half, PixelType::unorm8,
                                      PixelType::unorm16, PixelType::bc4, PixelType::bc5,
                                      PixelType::bc6h, PixelType::fp8, PixelType::fp16);

// These facts say what files of a format can hold. The code of a format adds further facts
// (bakers/io/formats).
struct FormatFacts {
    FileFormat format;
    std::string_view name;         // used in recipes and as the end of a file's name
    std::string_view description;  // helps a user to choose
    PixelTypes pixel_types;
    bool is_image = false;        // holds the slices of a volume in one image
    bool only_volumes = false;    // it cannot hold tables
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
    FormatFacts{.format = FileFormat::dds,
                .name = "dds",
                .description =
                    "DirectDraw Surface with all mips, a texture as GPUs load it; numbers "
                    "or blocks",
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
                .description = "NanoVDB, a grid per channel; float, half, fp8 or fp16",
                .pixel_types = nanovdb_types,
                .only_volumes = true},
    FormatFacts{.format = FileFormat::vol,
                .name = "vol",
                .description = "Mitsuba's grid volume of floats; float or half",
                .pixel_types = floating_types,
                .only_volumes = true},
    FormatFacts{.format = FileFormat::npy,
                .name = "npy",
                .description = "NumPy's array, of shape z, y, x, channel; any type of numbers",
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
    Ktx2Compression ktx2_compression = Ktx2Compression::zstd;
    Target target = Target::none;
    // For a scene, which the first frame of a sequence has alone.
    int frames = 0;  // of the sequence; 0: the asset is none, or not its first frame
    double frames_per_second = 24;
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
