// Measuring the error of a volume as stored, and the probes by which a runtime checks its lookups.
// Voxels are asked for one by one: the volume itself is never held.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "bakers/core/bake_options.h"
#include "bakers/core/volume.h"

namespace skybake {

// The exact values, one per channel, at texture coordinates: voxel i of an axis is at
// (i + 1/2) / size, whatever it samples. Asked for in [0, 1].
using VolumeReference = std::function<std::vector<double>(const std::array<double, 3>& uvw)>;

struct VolumeErrors {
    ErrorFigures figures;           // over all channels, in shares of each one's value range
    std::array<double, 3> worst{};  // texture coordinates of the largest
    int points = 0;
};

// Trilinear lookups of the voxels as stored, repeated or clamped as level.repeats says, at `count`
// points of the fixed set; at the voxel itself along axes that have but one.
VolumeErrors measure_lookups(const VolumeLevel& level, config::PixelType type,
                             const VolumeReference& reference, int count,
                             const BakeOptions& options);

// The voxels themselves: those that the same set falls into.
VolumeErrors measure_voxels(const VolumeLevel& level, config::PixelType type,
                            const VolumeReference& reference, int count,
                            const BakeOptions& options);

// Voxel centres and places between them, several across the seams.
std::vector<VolumeProbe> make_volume_probes(const VolumeLevel& level, config::PixelType type);

}  // namespace skybake
