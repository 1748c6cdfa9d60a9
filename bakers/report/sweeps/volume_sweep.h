// The variants of a volume that a report compares, whatever the volume is of.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bakers/field/baked.h"
#include "bakers/math/bake_options.h"
#include "config/sections/files.h"

namespace skybake {

// One way to make and store a volume. What is stored is a function of `voxels` and `size`; how, of
// the rest.
struct VolumeVariant {
    std::string family;
    std::string name;
    std::string baseline;
    bool of_recipe = false;
    bool in_quadrature_sweep = false;
    std::shared_ptr<const VoxelSource> voxels;  // shared by variants that have the same
    std::array<int, 3> size{};
    config::PixelType pixel_type = config::PixelType::half;
    config::FileFormat format = config::FileFormat::bin;
    config::Compression compression = config::Compression::none;            // of EXR
    config::VdbCompression vdb_compression = config::VdbCompression::none;  // of VDB
    // Processor time of making the voxels, of those that stand in memory already; none: taken by
    // making them.
    std::optional<double> seconds = {};
    // In place of the reference, as VolumeFinish::measure.
    std::function<Certificate(config::PixelType type, int points, const BakeOptions& options)>
        measure = {};
};

struct VolumeSweep {
    std::vector<VolumeVariant> variants;
    std::vector<std::string> notes;  // on what is left out
};

// Voxels times channels. A volume of so many is held as floats, and once more as the file that is
// made of it. 128 x 128 x 128 RGBA is 2^23, 256 x 256 x 256 is 2^26.
std::int64_t max_report_values(bool quick);

// What a sweep is about.
struct VolumeSubject {
    const config::AssetFiles& files;  // as the recipe has them
    bool of_recipe_size = false;      // whether `size` is the recipe's
    std::array<int, 3> size{};
    int channels = 1;
    std::function<std::shared_ptr<const VoxelSource>(const std::array<int, 3>& size)> make_voxels;
    // Why `bake` refuses a size; empty: it does not.
    std::function<std::string(const std::array<int, 3>& size)> refusal;
};

// Adds a variant to a sweep; its format is bin.
VolumeVariant& add_variant(VolumeSweep& sweep, std::string family, std::string name,
                           std::shared_ptr<const VoxelSource> voxels,
                           const std::array<int, 3>& size, config::PixelType pixel_type);

// Compressions of EXR and VDB at the subject's size, and sizes about it in all pixel types without
// compression. `own` are its voxels at its own size.
VolumeSweep storage_sweep(const VolumeSubject& subject,
                          const std::shared_ptr<const VoxelSource>& own, bool quick);

}  // namespace skybake
