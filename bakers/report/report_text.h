// The report's files: CSV for spreadsheets, JSON for programs. One picture an asset is in
// report_plot.h.
#pragma once

#include <string>
#include <vector>

#include "bakers/report/report.h"

namespace skybake {

// RFC 4180 but for line ends, one row a variant; the first line names the columns with their units.
std::string report_csv(const std::vector<AssetReport>& assets);

// One object; keys are those of the structs in report.h.
std::string report_json(const std::vector<AssetReport>& assets);

}  // namespace skybake
