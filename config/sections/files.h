// This header says what the files of assets are like, and how a volume's slices lie in an image.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "config/sections/file_formats.h"
#include "config/sections/pixel_types.h"

namespace skybake::config {

// These keys say what the files of one asset are like.
struct AssetFiles {
    std::vector<FileFormat> formats = {FileFormat::exr};  // without duplicates
    PixelType pixel_type = PixelType::float32;
    bool dither = false;                         // of tables: see bakers/field/dither.h
    SheetLayout layout = SheetLayout::stack;     // for images
    int columns = 0;                             // for an atlas; 0: chosen by slice_sheet
    bool flip = false;                           // for images: the last row is stored first
    int mips = 1;                                // levels of detail, including the asset itself
    Compression compression = Compression::zip;  // for EXR
    VdbCompression vdb_compression = VdbCompression::blosc;
    Ktx2Compression ktx2_compression = Ktx2Compression::zstd;
    Target target = Target::none;
    // For scenes and for a target's own files, which the first frame of a sequence has alone.
    int frames = 0;  // of the sequence; 0: the asset is none, or not its first frame
    double frames_per_second = 24;
};

// These are the keys of an asset whose channels are wavelengths.
struct LightFiles : AssetFiles {
    int packet =
        0;  // of wavelengths (frames.h), counted from 1; 0: the asset holds all wavelengths
};

// These are the keys of an asset that may be one of many frames.
struct VolumeFrames : AssetFiles {
    int frame = 0;  // counted from 1; 0: the time that noises and clouds have themselves
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
