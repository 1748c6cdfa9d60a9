// The report on an asset noise_volume.
#pragma once

#include "bakers/report/report.h"

namespace skybake {

// As report_asset, of a section with `asset = "noise_volume"`.
config::Outcome<AssetReport> report_noise_volume(const config::Recipe& recipe,
                                                 const config::Bake& bake,
                                                 const ReportOptions& options);

}  // namespace skybake
