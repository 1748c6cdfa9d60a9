// This header writes folders of reports, plans and previews, and checks those of reports and plans.
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

// Writes all files into the folder, which is made if it is missing, or none.
ExitCode write_files(const std::vector<NamedFile>& files, const std::filesystem::path& folder,
                     Console& console);

// Does the same and prints their paths as notes.
ExitCode write_report_files(const std::vector<NamedFile>& files,
                            const std::filesystem::path& folder, Console& console);

}  // namespace skybake::cli
