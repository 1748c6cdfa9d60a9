// The report of a cloud volume: sizes, pixel types and compressions, and what is saved by not
// making noise where there is no cloud.
#pragma once

#include "bakers/report/report.h"
#include "config/diagnostics/diagnostic.h"
#include "config/recipe/recipe.h"

namespace skybake {

// As report_asset.
config::Outcome<AssetReport> report_cloud_volume(const config::Recipe& recipe,
                                                 const config::Bake& bake,
                                                 const ReportOptions& options);

}  // namespace skybake
