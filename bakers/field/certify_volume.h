// Measuring the error of a volume as stored. Voxels are asked for one by one: the volume itself is
// never held.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "bakers/field/baked.h"
#include "bakers/math/bake_options.h"

namespace skybake {

// The exact values, one per channel, at texture coordinates: voxel i of an axis is at
// (i + 1/2) / size, whatever it samples. Asked for in [0, 1].
using VolumeReference = std::function<std::vector<double>(const std::array<double, 3>& uvw)>;

// How errors are measured where shares of each channel's value range would tell little. Members
// that are empty change nothing.
struct VolumeComparison {
    // The errors at texture coordinates, as many everywhere, from what was found and is wanted
    // there.
    std::function<std::vector<double>(const std::array<double, 3>& uvw,
                                      const std::vector<double>& found,
                                      const std::vector<double>& wanted)>
        errors;
    // The nearest texture coordinates to these that a lookup may have.
    std::function<std::array<double, 3>(const std::array<double, 3>& uvw)> lookup_place;
    std::string scale;  // what an error of 1 means
};

struct VolumeErrors {
    ErrorFigures figures;           // over all channels, or all errors of the comparison
    std::array<double, 3> worst{};  // texture coordinates of the largest
    int points = 0;
};

// Trilinear lookups of the voxels as stored, repeated or clamped as level.repeats says, at `count`
// points of the fixed set; at the voxel itself along axes that have but one.
VolumeErrors measure_lookups(const Level& level, config::PixelType type,
                             const VolumeReference& reference, int count,
                             const BakeOptions& options, const VolumeComparison& comparison = {});

// The voxels themselves: those that the same set falls into.
VolumeErrors measure_voxels(const Level& level, config::PixelType type,
                            const VolumeReference& reference, int count, const BakeOptions& options,
                            const VolumeComparison& comparison = {});

// What a lookup of the stored voxels finds, one value per channel.
std::vector<double> look_up(const Level& level, config::PixelType type,
                            const std::array<double, 3>& uvw);

}  // namespace skybake
