// The reports of occupancy grids and of distances to cloud: how much work empty-space skipping saves, and whether it loses
// samples.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "bakers/occupancy/marcher.h"
#include "bakers/report/report.h"
#include "config/diagnostics/diagnostic.h"
#include "config/recipe/recipe.h"

namespace skybake {

// Makes the report of an occupancy grid, as report_asset does.
config::Outcome<AssetReport> report_occupancy(const config::Recipe& recipe,
                                              const config::Bake& bake,
                                              const ReportOptions& options);

// Makes the report of distances, beside those of grids with cells as large as its texels.
config::Outcome<AssetReport> report_cloud_distance(const config::Recipe& recipe,
                                                   const config::Bake& bake,
                                                   const ReportOptions& options);

// One of the three sets of fixed rays through a repeating tile, with which skipping is measured.
struct RaySet {
    std::string name;  // "up", "within", "down"
    std::vector<occupancy::Ray> rays;
};

// Returns three sets of `count` rays through a tile of this extent, by Roberts' sequence in five
// dimensions:
//   up      from its base, the cosine of the zenith angle uniform in [cos 60 deg, 1]
//   within  from its lower quarter, directions uniform on the sphere
//   down    from its top, as up, mirrored
//
// For a tile of 600 units along each axis they are the rays of tests/data/rays_*.csv, to the digits
// printed there.
std::array<RaySet, 3> skipping_rays(const std::array<double, 3>& extent, int count);

}  // namespace skybake
