// Opens the volumes that a recipe names: [volumes.NAME].
#pragma once

#include "bakers/field/source_voxels.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/volume.h"

namespace skybake {

// Returns the voxels of a volume as a cloud has them: cut, turned so that z is up, with a border, and
// with values times `scale`. Voxels are read from the file as they are asked for.
//
// E0300 if a file cannot be read, E0304 if it is not what the recipe says (vdb_source.h,
// nvdb_source.h, raw_volume.h), E0110 if a crop or border leaves no voxel of the
// file or makes more than 16384 along an axis. All of them point to `file` in the recipe.
Outcome<SourceVoxels> open_volume(const config::VolumeFile& volume);

// Returns only the shape, from the head of the file. Programs give it to set_volume_probe.
Outcome<config::VolumeShape> read_volume_shape(const config::VolumeFile& volume);

}  // namespace skybake
