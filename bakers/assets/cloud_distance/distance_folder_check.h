// Checks the distances of a folder on the voxels of its files.
#pragma once

#include "bakers/io/manifest/verify.h"

namespace skybake {

// Returns a check of the cloud_distance assets of a folder. For each one whose volume the manifest
// has, too, it reads both from their files and compares 65536 lookups, as many texels and the steps of
// 10000 rays with exact distances (distance_check.h). A distance that is too far, or nearer than it
// need be, is a failure.
FolderCheck distance_folder_check();

}  // namespace skybake
