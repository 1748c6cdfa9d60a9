// What the files of assets are like.
#pragma once

#include <vector>

namespace skybake::config {

enum class PixelType { float32, half, unorm8, unorm16 };  // "float" ...; tables: the first two
enum class Compression { none, zip, zips, piz };

enum class VolumeFormat { exr, vdb, bin };
enum class VolumeLayout { stack, atlas };
enum class VdbCompression { none, zip, blosc };

// What the files of a volume are like.
struct VolumeFiles {
    std::vector<VolumeFormat> formats;  // without duplicates
    PixelType pixel_type = PixelType::half;
    VolumeLayout layout = VolumeLayout::stack;   // of EXR
    int columns = 0;                             // of an atlas; 0: chosen
    int mips = 1;                                // levels, the volume itself among them
    Compression compression = Compression::zip;  // of EXR
    VdbCompression vdb_compression = VdbCompression::blosc;
};

}  // namespace skybake::config
