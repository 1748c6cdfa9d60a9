// The table of `report --truth`, for people.
#pragma once

#include <string>

#include "bakers/report/truth/sky_truth_report.h"

namespace skybake::cli {

std::string sky_truth_table(const SkyErrorReport& report);

}  // namespace skybake::cli
