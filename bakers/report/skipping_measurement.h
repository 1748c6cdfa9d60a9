// How much work the ways of skipping what is empty save, on the voxels of a volume in memory.
#pragma once

#include <optional>
#include <vector>

#include "bakers/occupancy/marcher.h"
#include "bakers/report/measured_distance.h"
#include "bakers/report/report.h"
#include "config/assets/occupancy.h"

namespace skybake {

// Measures all ways of skipping, that by distances too if `distance` is not null. The size, cell and
// number of repetitions are filled in. Returns nothing after an interruption.
std::optional<SkippingFacts> measure_skipping(const std::vector<float>& voxels,
                                              const occupancy::MarchedVolume& volume,
                                              const config::OccupancyBake& bake,
                                              MeasuredDistance* distance,
                                              const ReportOptions& options);

// Returns how often a grid is made, of which the median time counts.
int grid_repetitions(const ReportOptions& options);

}  // namespace skybake
