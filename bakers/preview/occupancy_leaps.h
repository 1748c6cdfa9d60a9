// Leaps (empty-space skip distances) for a march, from a baked occupancy grid.
#pragma once

#include <optional>

#include "bakers/march/cloud_medium.h"
#include "bakers/render/sky_tables.h"
#include "config/assets/occupancy.h"

namespace skybake {

// Returns leaps in cells, one per cell of the grid, from the first of the channels `leap`,
// `occupied` and `maximum` that the grid has. Returns nothing if it has no such channel, or if it
// does not have one value per cell and channel.
std::optional<std::vector<float>> leaps_of_grid(const PreviewAsset& grid, const OccupancyBake& bake,
                                                float threshold);

// Returns leaps for a march through `volume`, if they are certain to lose nothing
// (cloud_pictures.h).
std::optional<LeapGrid> leap_grid_of(const PreviewAsset& volume, const PreviewAsset& grid,
                                     const OccupancyBake& bake, float threshold);

}  // namespace skybake
