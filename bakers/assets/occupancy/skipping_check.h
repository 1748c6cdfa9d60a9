// Whether the occupancy grids of a folder lose anything of the volumes that they are of.
#pragma once

#include "bakers/io/manifest/verify.h"

namespace skybake {

// For each occupancy grid of a manifest that also has its volume: draws 10^6 filtered samples from
// the stored voxels; one that is something in a cell which the stored grid says is empty is a
// failure. A grid without the channels that say so (occupied, leap or maximum) is not checked.
FolderCheck skipping_check();

}  // namespace skybake
