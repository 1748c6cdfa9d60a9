// The variants of a volume that a report compares, for all kinds of volumes.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bakers/field/conventions.h"
#include "bakers/field/level.h"
#include "bakers/math/bake_options.h"
#include "config/sections/file_formats.h"
#include "config/sections/forward.h"
#include "config/sections/pixel_types.h"

namespace skybake {

// One way to make and store a volume. `voxels` and `size` decide what is stored, the other members
// how.
struct VolumeVariant {
    std::string family;
    std::string name;
    std::string baseline;
    bool of_recipe = false;
    bool in_quadrature_sweep = false;
    std::shared_ptr<const VoxelSource> voxels;  // shared by variants with the same voxels
    std::array<int, 3> size{};
    config::PixelType pixel_type = config::PixelType::half;
    config::FileFormat format = config::FileFormat::bin;
    config::Compression compression = config::Compression::none;            // for EXR
    config::VdbCompression vdb_compression = config::VdbCompression::none;  // for VDB
    // The processor time of making the voxels, in seconds, if they are already in memory; none: it
    // is measured by making them.
    std::optional<double> seconds = {};
    // Replaces the reference, as VolumeFinish::measure does.
    std::function<Certificate(config::PixelType type, int points, const BakeOptions& options)>
        measure = {};
};

struct VolumeSweep {
    std::vector<VolumeVariant> variants;
    std::vector<std::string> notes;  // on variants that were left out
};

// Returns the largest number of values (voxels times channels) of a volume in a report. Such a
// volume is held in memory as floats and once more as its file. 128 x 128 x 128 RGBA is 2^23, and
// 256 x 256 x 256 RGBA is 2^26.
std::int64_t max_report_values(bool quick);

// The volume that a sweep is about.
struct VolumeSubject {
    const config::AssetFiles& files;  // as in the recipe
    bool of_recipe_size = false;      // whether `size` is the recipe's
    std::array<int, 3> size{};
    int channels = 1;
    std::function<std::shared_ptr<const VoxelSource>(const std::array<int, 3>& size)> make_voxels;
    // Returns why `bake` refuses a size; empty: it does not.
    std::function<std::string(const std::array<int, 3>& size)> refusal;
};

// Adds a variant to a sweep; its format is bin.
VolumeVariant& add_variant(VolumeSweep& sweep, std::string family, std::string name,
                           std::shared_ptr<const VoxelSource> voxels,
                           const std::array<int, 3>& size, config::PixelType pixel_type);

// Returns variants with the compressions of EXR and VDB at the subject's size, and with sizes
// around it in all pixel types without compression. `own` are the subject's voxels at its own size.
VolumeSweep storage_sweep(const VolumeSubject& subject,
                          const std::shared_ptr<const VoxelSource>& own, bool quick);

}  // namespace skybake
