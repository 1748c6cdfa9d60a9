// This header checks and writes the folder of a report or a plan.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bakers/report/report_files.h"
#include "cli/options.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake::cli {

namespace options {

inline const Option<bool> quick{"quick"};
inline const Option<bool> csv{"csv"};

}  // namespace options

// Checks whether files with these names may be written. It is called before the report, which takes
// a minute. Reports E0302, and E0303 unless `force` is set.
[[nodiscard]] std::vector<Diagnostic> check_report_folder(const std::filesystem::path& folder,
                                                          const std::vector<std::string>& names,
                                                          bool force);

// Writes all files or none. Their paths are printed as notes.
ExitCode write_report_files(const std::vector<ReportFile>& files,
                            const std::filesystem::path& folder, Console& console);

}  // namespace skybake::cli
