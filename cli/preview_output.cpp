#include "cli/preview_output.h"

#include "bakers/io/atomic_file.h"
#include "bakers/io/output_folder.h"
#include "bakers/preview/preview_files.h"
#include "cli/bake_progress.h"
#include "cli/console.h"

namespace skybake::cli {

ExitCode check_output(const PreviewRequest& request, Console& console) {
    const auto folder = inspect_output_folder(request.output, {}, true);
    if (const ExitCode code = console.report(folder.diagnostics); !folder.value) return code;
    if (request.force) return ExitCode::done;
    return console.report(foreign_preview_files(request.output, {{page_name, ""}}));
}

ExitCode write_preview(const PreviewPage& page, const PreviewRequest& request, Console& console,
                       std::vector<std::string>& paths) {
    const std::vector<PreviewFile> files = preview_files(page);
    if (!request.force) {
        const auto foreign = foreign_preview_files(request.output, files);
        if (!foreign.empty()) return console.report(foreign);
    }
    const auto made = create_output_folder(request.output);
    if (const ExitCode code = console.report(made.diagnostics); !made.value) return code;
    const BakeProgress progress("write", console);
    AtomicFiles atomic;
    for (const PreviewFile& file : files) {
        const auto path = request.output / file.name;
        const auto staged = atomic.stage(path, std::string_view(file.bytes), &progress);
        if (const ExitCode code = console.report(staged.diagnostics); !staged.value) return code;
        if (*staged.value == WriteResult::interrupted) return ExitCode::interrupted;
        paths.push_back(path.string());
    }
    return console.report(atomic.commit());
}

}  // namespace skybake::cli
