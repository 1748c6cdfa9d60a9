// The files of a report: CSV for spreadsheets, JSON for programs, one plot for each asset
// (report_plot.h); and the signs by which it knows its own.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/report/report.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// RFC 4180 but for line ends, one row a variant; the first line names the columns with their units.
std::string report_csv(const std::vector<AssetReport>& assets);

// One object; keys are those of the structs in report.h.
std::string report_json(const std::vector<AssetReport>& assets);

struct ReportFile {
    std::string name;  // relative to the report's folder
    std::string text;
};

// report.csv, report.json and NAME.svg for each asset.
std::vector<ReportFile> report_files(const std::vector<AssetReport>& assets);

// Their names, before the report is made.
std::vector<std::string> report_file_names(const std::vector<std::string>& assets);

// Whether a text that stands under such a name was written by report_files, or under the like by
// `report --truth`.
bool is_report_text(std::string_view name, std::string_view text);

// E0303 for each file of these names that is in the folder and is not a report's.
std::vector<config::Diagnostic> foreign_report_files(const std::filesystem::path& folder,
                                                     const std::vector<std::string>& names);

}  // namespace skybake
