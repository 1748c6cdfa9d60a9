// The folder of a report, and the report of the sky.
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
inline const Option<std::int64_t> truth_paths{"truth-paths", 0, "N", {}, read_truth_paths};
inline const Option<bool> quick{"quick"};
inline const Option<bool> csv{"csv"};

}  // namespace options

// Whether files of these names may be written: asked before the minute that a report takes.
// E0302; E0303 unless forced.
[[nodiscard]] std::vector<config::Diagnostic> check_report_folder(
    const std::filesystem::path& folder, const std::vector<std::string>& names, bool force);

// All or none of them; their paths are notes.
ExitCode write_report_files(const std::vector<ReportFile>& files,
                            const std::filesystem::path& folder, Console& console);

// `report --truth`: the sky of a recipe by each method of multiple scattering, against path
// tracing.
ExitCode report_truth(const Invocation& invocation, Console& console);

}  // namespace skybake::cli
