// Plots of a sweep: what each asset's error costs, over the user's own axes.
#pragma once

#include <vector>

#include "bakers/plot/drawing.h"
#include "bakers/preview/load_sweep.h"

namespace skybake {

// Returns a plot of each asset whose error or cost varies: its error against the bytes of its files,
// and against the time of its bake if that is known. The error is the median of the sky's if that was
// measured, else the RMS of lookups.
std::vector<PreviewPicture> sweep_plots(const PreviewSweep& sweep);

}  // namespace skybake
