// The report of asset = "bruneton".
#pragma once

#include "bakers/report/report.h"
#include "config/diagnostics/diagnostic.h"
#include "config/recipe/recipe.h"

namespace skybake {

// Methods, sizes and pixel types of a table of scattering (bruneton_scattering_sweep.h), sizes and
// pixel types of the others. As report_asset; `quick` has sizes below that of a recipe's own where
// making that takes seconds.
config::Outcome<AssetReport> report_bruneton(const config::Recipe& recipe, const config::Bake& bake,
                                             const ReportOptions& options);

}  // namespace skybake
