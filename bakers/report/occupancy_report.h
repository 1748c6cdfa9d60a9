// The report of an occupancy grid: what skipping by it saves, and whether it loses anything.
#pragma once

#include "bakers/report/report.h"
#include "config/diagnostics/diagnostic.h"
#include "config/recipe/recipe.h"

namespace skybake {

// As report_asset.
config::Outcome<AssetReport> report_occupancy(const config::Recipe& recipe,
                                              const config::Bake& bake,
                                              const ReportOptions& options);

}  // namespace skybake
