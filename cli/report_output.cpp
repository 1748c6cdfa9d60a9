#include "cli/report_output.h"

#include "bakers/io/files/atomic_file.h"
#include "bakers/io/files/output_folder.h"
#include "bakers/io/files/temporary_file.h"
#include "cli/bake_progress.h"
#include "cli/console.h"

namespace skybake::cli {

std::vector<config::Diagnostic> check_report_folder(const std::filesystem::path& folder,
                                                    const std::vector<std::string>& names,
                                                    bool force) {
    // No file is named: report_files.h knows its own, which no manifest claims.
    auto diagnostics = inspect_output_folder(folder, {}, true).diagnostics;
    if (force || !diagnostics.empty()) return diagnostics;
    return foreign_report_files(folder, names);
}

ExitCode write_report_files(const std::vector<ReportFile>& files,
                            const std::filesystem::path& folder, Console& console) {
    const auto made = create_output_folder(folder);
    if (const ExitCode code = console.report(made.diagnostics); !made.value) return code;
    remove_stale_temporaries_in(folder);
    const BakeProgress progress("write", console);
    AtomicFiles atomic;
    for (const ReportFile& file : files) {
        const auto staged = atomic.stage(folder / file.name, file.text, &progress);
        if (const ExitCode code = console.report(staged.diagnostics); !staged.value) return code;
        if (*staged.value == WriteResult::interrupted) return ExitCode::interrupted;
    }
    if (const auto diagnostics = atomic.commit(); !diagnostics.empty()) {
        return console.report(diagnostics);
    }
    for (const ReportFile& file : files) console.note((folder / file.name).string() + "\n");
    return ExitCode::done;
}

}  // namespace skybake::cli
