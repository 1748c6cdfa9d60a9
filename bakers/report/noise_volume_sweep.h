// What a report compares for `asset = "noise_volume"`.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "bakers/core/volume.h"
#include "config/parameters.h"

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
    config::VolumeFormat format = config::VolumeFormat::bin;
    config::Compression compression = config::Compression::none;            // of EXR
    config::VdbCompression vdb_compression = config::VdbCompression::none;  // of VDB
};

struct VolumeSweep {
    std::vector<VolumeVariant> variants;
    std::vector<std::string> notes;  // on what is left out
};

// The size that a report is about: the bake's own, halved until it is measured in seconds.
std::array<int, 3> report_size(const config::Noise& noise, const config::NoiseVolumeBake& bake,
                               bool quick);

// About the volume of `size` voxels: sizes, pixel types, octaves and compressions, and the same
// voxels made point by point.
VolumeSweep noise_volume_sweep(const config::Noise& noise, const config::NoiseVolumeBake& bake,
                               std::array<int, 3> size, bool quick);

}  // namespace skybake
