// The files of a report: CSV for spreadsheets, JSON for programs, and one plot for each asset. The
// header also recognises files that a report or a plan wrote.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/plot/chart.h"
#include "bakers/report/report.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// Returns CSV as in RFC 4180 except for its line ends, with one row per variant. The first line
// names the columns with their units.
std::string report_csv(const std::vector<AssetReport>& assets);

// Returns one JSON object. Its keys are those of the structs in report.h.
std::string report_json(const std::vector<AssetReport>& assets);

// A file of a report, a plan or a preview, before it is written.
struct NamedFile {
    std::string name;  // relative to its folder
    std::string bytes;
};

// Returns report.csv, report.json and NAME.svg for each asset.
std::vector<NamedFile> report_files(const std::vector<AssetReport>& assets);

// Returns the names of these files, before the report is made.
std::vector<std::string> report_file_names(const std::vector<std::string>& assets);

// Whether a file with this name and text was written by report_files or by `plan`.
bool is_report_text(std::string_view name, std::string_view text);

// Returns E0303 for each file with one of these names that is in the folder and that no report
// wrote.
[[nodiscard]] std::vector<Diagnostic> foreign_report_files(const std::filesystem::path& folder,
                                                           const std::vector<std::string>& names);

// The comment in SVG files by which reports recognise their own plots.
inline constexpr std::string_view report_plot_sign = "skybake report";

// Plots an asset: time and bytes against lookup error.
Figure report_figure(const AssetReport& asset);

std::string report_svg(const Figure& figure);

}  // namespace skybake
