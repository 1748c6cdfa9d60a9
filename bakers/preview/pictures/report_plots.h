// The plots of speed against error that `report` draws, for the pages of previews.
#pragma once

#include <filesystem>

#include "bakers/math/progress.h"
#include "bakers/preview/preview_assets.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// Adds the plots of the assets that an earlier `report` left in the folder, or in `report` below
// it. Files of these names that are none of its drawings are passed over.
void find_plots(const std::filesystem::path& folder, PreviewAssets& assets);

// Measures each asset of the recipe by a quick report and adds its plot; assets that have nothing
// to plot get none. Errors as of report_asset; none and assets without plots: the user has
// interrupted.
std::vector<config::Diagnostic> measure_plots(PreviewAssets& assets, int threads,
                                              Progress* progress);

}  // namespace skybake
