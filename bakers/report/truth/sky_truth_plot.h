// The picture of a report on the sky's error: the time of each method against its error.
#pragma once

#include <string>

#include "bakers/report/truth/sky_truth_report.h"

namespace skybake {

std::string sky_truth_svg(const SkyErrorReport& report);

}  // namespace skybake
