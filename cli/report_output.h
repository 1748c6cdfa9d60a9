// The folder of a report.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bakers/report/report_files.h"
#include "cli/exit_code.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake::cli {

class Console;

// Whether files of these names may be written: asked before the minute that a report takes.
// E0302; E0303 unless forced.
std::vector<config::Diagnostic> check_report_folder(const std::filesystem::path& folder,
                                                    const std::vector<std::string>& names,
                                                    bool force);

// All or none of them; their paths are notes.
ExitCode write_report_files(const std::vector<ReportFile>& files,
                            const std::filesystem::path& folder, Console& console);

}  // namespace skybake::cli
