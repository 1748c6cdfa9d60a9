// Voxels of a volume's files, whatever the format, along the axes of the file's space.
#pragma once

#include <array>
#include <memory>

#include "bakers/field/level.h"
#include "bakers/io/volumes/value_faults.h"

namespace skybake {

struct FileVoxels {
    std::array<int, 3> first{};            // index of the first voxel
    std::array<int, 3> size{};             // from there
    std::array<double, 3> voxel_size{};    // edges, in the file's units; 0 if it does not say
    std::array<double, 3> index_origin{};  // lower corner of voxel (0, 0, 0) in the file's space
    bool has_place = false;                // the file says where in space it lies
    ValueFaults faults;                    // if the voxels were asked for
    float background = 0;
    float largest = 0;  // no value is above it, `background` included
    // One channel, by index. A box may reach beyond the voxels, where there is background. Null if
    // only the shape was asked for. It throws if the file changes while it is read.
    std::shared_ptr<const VoxelSource> voxels;
};

// What is asked for of a file: the shape alone; voxels that are densities; or its numbers as they are,
// also those of level sets and those that are not finite, with neither faults nor `largest`. The box
// of numbers may be empty.
enum class VolumePart { shape, voxels, numbers };

}  // namespace skybake
