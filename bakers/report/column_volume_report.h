// The report of a table of columns: exact quadrature beside sums over shells, of one thickness and
// of equal attenuation, more and more of them.
#pragma once

#include "bakers/report/report.h"
#include "config/diagnostics/diagnostic.h"
#include "config/recipe/recipe.h"

namespace skybake {

// As report_asset. Densities and phase functions have nothing to sum, and nothing to compare.
config::Outcome<AssetReport> report_column_volume(const config::Recipe& recipe,
                                                  const config::Bake& bake,
                                                  const ReportOptions& options);

}  // namespace skybake
