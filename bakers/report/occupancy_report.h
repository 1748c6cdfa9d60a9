// The report of an occupancy grid: what skipping by it saves, and whether it loses anything.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "bakers/occupancy/marcher.h"
#include "bakers/report/report.h"
#include "config/diagnostics/diagnostic.h"
#include "config/recipe/recipe.h"

namespace skybake {

// As report_asset.
config::Outcome<AssetReport> report_occupancy(const config::Recipe& recipe,
                                              const config::Bake& bake,
                                              const ReportOptions& options);

// The fixed rays that skipping is measured with: three sets through a tile that repeats.
struct RaySet {
    std::string name;  // "up", "within", "down"
    std::vector<occupancy::Ray> rays;
};

// `count` rays each, through a tile of this extent:
//   up      from its base, the cosine of the zenith angle uniform in [cos 60 deg, 1]
//   within  from its lower quarter, directions uniform on the sphere
//   down    from its top, as up, mirrored
// by Roberts' sequence in five dimensions. With a tile of 600 units each way they are those of
// tests/data/rays_*.csv, to the digits printed there.
std::array<RaySet, 3> skipping_rays(const std::array<double, 3>& extent, int count);

}  // namespace skybake
