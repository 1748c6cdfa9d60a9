// The files of a report on the sky's error: CSV for spreadsheets, JSON for programs.
#pragma once

#include <string>

#include "bakers/report/truth/sky_truth_report.h"

namespace skybake {

// One row a method and one of the truth's own standard error; the first line names the columns.
// Errors are shares, of 1; dome_rms_SUN_CHANNEL as of SkyErrorFigures, SUN in degrees from the
// zenith.
std::string sky_truth_report_csv(const SkyErrorReport& report);

// One object; keys are those of the structs in sky_truth_report.h.
std::string sky_truth_report_json(const SkyErrorReport& report);

}  // namespace skybake
