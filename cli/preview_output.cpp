#include "cli/preview_output.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "bakers/io/files/atomic_file.h"
#include "bakers/io/files/output_folder.h"
#include "bakers/io/files/temporary_file.h"
#include "bakers/preview/preview_files.h"
#include "cli/bake_progress.h"
#include "cli/console.h"

namespace skybake::cli {
namespace {

namespace fs = std::filesystem;

// Those that lie there and are none of this preview's.
std::vector<std::string> retired(const fs::path& folder, const std::vector<std::string>& earlier,
                                 const std::vector<std::string>& names) {
    std::vector<std::string> left;
    for (const std::string& name : earlier) {
        std::error_code error;
        const bool made = std::find(names.begin(), names.end(), name) != names.end();
        if (!made && fs::exists(folder / name, error)) left.push_back(name);
    }
    return left;
}

}  // namespace

ExitCode check_output(const PreviewRequest& request, Console& console) {
    const auto folder = inspect_output_folder(request.output, {}, true);
    if (const ExitCode code = console.report(folder.diagnostics); !folder.value) return code;
    if (request.force) return ExitCode::done;
    return console.report(
        foreign_preview_files(request.output, {page_name}, earlier_preview_files(request.output)));
}

ExitCode write_preview(PreviewPage page, const PreviewRequest& request, Console& console,
                       std::vector<std::string>& paths) {
    const std::vector<std::string> earlier = earlier_preview_files(request.output);
    const std::vector<std::string> names = preview_file_names(page);
    if (!request.force) {
        const auto foreign = foreign_preview_files(request.output, names, earlier);
        if (!foreign.empty()) return console.report(foreign);
    }
    page.retired = retired(request.output, earlier, names);
    const auto made = create_output_folder(request.output);
    if (const ExitCode code = console.report(made.diagnostics); !made.value) return code;
    remove_stale_temporaries_in(request.output);
    const BakeProgress progress("write", console);
    AtomicFiles atomic;
    for (const PreviewFile& file : preview_files(page)) {
        const auto path = request.output / file.name;
        const auto staged = atomic.stage(path, std::string_view(file.bytes), &progress);
        if (const ExitCode code = console.report(staged.diagnostics); !staged.value) return code;
        if (*staged.value == WriteResult::interrupted) return ExitCode::interrupted;
        paths.push_back(path.string());
    }
    return console.report(atomic.commit());
}

}  // namespace skybake::cli
