// The files of a report: CSV for spreadsheets, JSON for programs, one plot for each asset
// (report_files.h); and the signs by which it knows its own.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/plot/chart.h"
#include "bakers/report/report.h"
#include "bakers/report/truth/sky_truth_report.h"
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
[[nodiscard]] std::vector<config::Diagnostic> foreign_report_files(
    const std::filesystem::path& folder, const std::vector<std::string>& names);

// The plots of reports, as SVG files.

// A comment by which reports know their files.
inline constexpr std::string_view report_plot_sign = "skybake report";

// Of an asset: time against lookup error, and against texel error for the quadrature sweep; of
// volumes, bytes against lookup error too.
Figure report_figure(const AssetReport& asset);

// Of the sky: the time of each method against its error.
Figure sky_truth_figure(const SkyErrorReport& report);

std::string report_svg(const Figure& figure);

}  // namespace skybake
