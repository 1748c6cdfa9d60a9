// The picture of an asset's report: time against lookup error, and against texel error for the
// quadrature sweep; of volumes, bytes against lookup error too.
#pragma once

#include <string>

#include "bakers/report/report.h"

namespace skybake {

std::string report_svg(const AssetReport& asset);

}  // namespace skybake
