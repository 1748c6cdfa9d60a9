// What a baked occupancy grid tells a march.
#pragma once

#include <optional>

#include "bakers/render/cloud_medium.h"
#include "bakers/render/sky_tables.h"
#include "config/assets/occupancy.h"

namespace skybake {

// Leaps in cells, one per cell of the grid, from the first of its channels `leap`, `occupied` and
// `maximum` that is there. None without such a channel, or with other than a value per cell and
// channel.
std::optional<std::vector<float>> leaps_of_grid(const PreviewAsset& grid,
                                                const config::OccupancyBake& bake, float threshold);

// Leaps of a march through `volume`, where they are sure to lose nothing (cloud_pictures.h).
std::optional<LeapGrid> leap_grid_of(const PreviewAsset& volume, const PreviewAsset& grid,
                                     const config::OccupancyBake& bake, float threshold);

}  // namespace skybake
