// This header checks and writes the folder of a report, and declares the report of the sky.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "bakers/report/report_files.h"
#include "cli/options.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake::cli {

namespace options {

config::Outcome<std::int64_t> read_truth_paths(const std::string& text);

inline const Option<bool> truth{"truth"};
inline const Option<bool> colors{"colors"};
inline const Option<std::int64_t> truth_paths{"truth-paths", 0, "N", {}, read_truth_paths};
inline const Option<bool> quick{"quick"};
inline const Option<bool> csv{"csv"};

}  // namespace options

// Checks whether files with these names may be written. It is called before the report, which takes
// a minute. Reports E0302, and E0303 unless `force` is set.
[[nodiscard]] std::vector<config::Diagnostic> check_report_folder(
    const std::filesystem::path& folder, const std::vector<std::string>& names, bool force);

// Writes all files or none. Their paths are printed as notes.
ExitCode write_report_files(const std::vector<ReportFile>& files,
                            const std::filesystem::path& folder, Console& console);

// Runs `report --truth`, which compares the sky of a recipe by each method of multiple scattering
// with path tracing.
ExitCode report_truth(const Invocation& invocation, Console& console);

// Runs `report --colors`, which compares numbers of wavelengths and ways of using them.
ExitCode report_color(const Invocation& invocation, Console& console);

// Writes a percentage with three digits, but at most two decimals.
std::string percent_text(double share);

}  // namespace skybake::cli
