// This header declares volumes that come from files: [volumes.NAME].
#pragma once

#include <array>
#include <filesystem>
#include <string>

#include "config/diagnostics/diagnostic.h"
#include "config/sections/pixel_types.h"
#include "config/text/quantity.h"

namespace skybake::config {

enum class VolumeFormat { vdb, nvdb, raw };
enum class ByteOrder { little, big };
enum class VolumeUp { z, y };
enum class VolumeWrap { empty, repeat };
enum class NotFinite { refuse, background };

// The axes from the one along which neighbours are adjacent in the file to the slowest one.
enum class AxisOrder { xyz, xzy, yxz, yzx, zxy, zyx };

// This is the box of voxels that a file gives, once its axes are turned so that z is up, it is cut
// and its border is added.
struct VolumeShape {
    std::array<int, 3> size{};             // voxels
    std::array<double, 3> voxel_size_m{};  // edges of a voxel
    std::array<double, 3> corner_m{};  // of its lowest voxel in the file's space; 0 if it has none

    bool operator==(const VolumeShape&) const = default;
};

// This is one [volumes.NAME]. Sizes and crops are along the file's own axes.
struct VolumeFile {
    std::string name;
    std::string file;            // as the recipe spells it
    std::filesystem::path path;  // of the file
    VolumeFormat format = VolumeFormat::vdb;
    std::string grid;           // vdb and nvdb; empty: density, or the only one of numbers
    std::array<int, 3> size{};  // raw
    PixelType type = PixelType::float32;  // raw
    ByteOrder byte_order = ByteOrder::little;
    AxisOrder axis_order = AxisOrder::xyz;
    int offset = 0;  // raw: bytes before the voxels
    std::array<Length, 3> voxel_size;  // 0: what the file says
    std::array<int, 3> crop_first{};   // index of the first voxel that counts
    std::array<int, 3> crop_size{};    // 0: all voxels, or those of the crop in metres
    std::array<Length, 3> crop_corner;
    std::array<Length, 3> crop_extent;  // 0: no crop in metres
    VolumeUp up_axis = VolumeUp::z;
    double scale = 1;
    VolumeWrap wrap = VolumeWrap::empty;
    int border = 0;
    NotFinite not_finite = NotFinite::refuse;
    SourceRange file_place;  // of `file` in the recipe

    bool operator==(const VolumeFile&) const = default;
};

// Reads what the files of a volume say of its shape, or E0300 or E0304.
using VolumeProbe = Outcome<VolumeShape> (*)(const VolumeFile& volume);

// Sets the function that reads the shapes of volumes whose clouds give no extent, because config reads
// no volumes itself. Programs call it once, before they load a recipe. Without it a cloud of a volume
// must give its extent.
void set_volume_probe(VolumeProbe probe);

// Returns that function, or null.
VolumeProbe volume_probe();

}  // namespace skybake::config
