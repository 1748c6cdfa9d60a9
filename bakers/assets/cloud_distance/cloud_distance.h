// The asset cloud_distance: how far it is from the texels of a grid to the cloud of a volume.
#pragma once

#include "bakers/assets/occupancy/occupancy_grid.h"
#include "bakers/math/bake_options.h"
#include "bakers/occupancy/stored_distance.h"
#include "config/assets/cloud_distance.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

struct Baked;

// Height over which the detail type goes from 0 to 1 where the cloud has no detail, as a share of the
// cloud's height: Schneider & Vos 2015.
inline constexpr double kUsualWispHeight = 0.1;

// Returns how the distances of a bake are stored, of a volume with these edges of a voxel.
occupancy::DistanceCode distance_code(const config::CloudDistanceBake& bake,
                                      const std::array<double, 3>& voxel_m);

// Fills all of `volume` except its name and parameters. A voxel of it is a texel of bake.cell voxels
// of `of`, and its channels are bake.contents. Returns E0401 and E0402 as for volumes, E0405 if a
// distance failed its check, and neither value nor diagnostics after an interruption.
Outcome<Baked> bake_cloud_distance(const OccupiedVolume& of, const config::CloudDistanceBake& bake,
                                   double wisp_height, const BakeOptions& options, Baked volume);

}  // namespace skybake
