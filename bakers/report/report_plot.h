// The plots of reports, as SVG files.
#pragma once

#include <string>
#include <string_view>

#include "bakers/plot/chart.h"
#include "bakers/report/report.h"
#include "bakers/report/truth/sky_truth_report.h"

namespace skybake {

// A comment by which reports know their files.
inline constexpr std::string_view report_plot_sign = "skybake report";

// Of an asset: time against lookup error, and against texel error for the quadrature sweep; of
// volumes, bytes against lookup error too.
Figure report_figure(const AssetReport& asset);

// Of the sky: the time of each method against its error.
Figure sky_truth_figure(const SkyErrorReport& report);

std::string report_svg(const Figure& figure);

}  // namespace skybake
