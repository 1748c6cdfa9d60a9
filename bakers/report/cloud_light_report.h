// The report of light within a cloud: what the size of texels costs, and what fitting them gains.
#pragma once

#include "bakers/report/report.h"
#include "config/diagnostics/diagnostic.h"
#include "config/recipe/recipe.h"

namespace skybake {

// Compares texels of 2 to 16 voxels, fitted and as values at their centres. Outcomes are those of
// report_asset.
config::Outcome<AssetReport> report_cloud_light(const config::Recipe& recipe,
                                                const config::Bake& bake,
                                                const ReportOptions& options);

}  // namespace skybake
