// skybake preview: pictures of recipes and of baked files, and one page of all of them.
#include <fmt/format.h>

#include <array>
#include <chrono>
#include <string>
#include <vector>

#include "bakers/preview/bake_assets.h"
#include "bakers/preview/label.h"
#include "bakers/preview/load_assets.h"
#include "bakers/preview/make_preview.h"
#include "bakers/preview/report_plots.h"
#include "bakers/preview/sweep_preview.h"
#include "cli/bake_progress.h"
#include "cli/bake_selection.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/interrupt.h"
#include "cli/preview_output.h"
#include "cli/preview_request.h"
#include "cli/watch_preview.h"

namespace skybake::cli {
namespace {

using config::Outcome;
using Subject = PreviewRequest::Subject;

Outcome<PreviewAssets> bake_recipe(const Invocation& invocation, const PreviewRequest& request,
                                   Progress& progress) {
    auto selection = select_bakes(invocation);
    if (!selection.value) return {{}, std::move(selection.diagnostics)};
    auto assets = bake_assets(selection.value->recipe, selection.value->bakes,
                              request.paths[0].filename().string(),
                              {selection.value->threads, Certification::quick, &progress});
    assets.diagnostics.insert(assets.diagnostics.begin(), selection.diagnostics.begin(),
                              selection.diagnostics.end());
    return assets;
}

Outcome<PreviewAssets> gather(const Invocation& invocation, const PreviewRequest& request,
                              Progress& progress) {
    if (request.subject == Subject::recipe) return bake_recipe(invocation, request, progress);
    if (request.subject == Subject::folder) return load_folder(request.paths[0]);
    return load_files(request.paths);
}

// No value and no errors: the user has interrupted.
Outcome<PreviewPage> make_page(const Invocation& invocation, const PreviewRequest& request,
                               Progress& progress) {
    PreviewOptions options = request.options;
    options.progress = &progress;
    if (request.subject == Subject::sweep) return make_sweep_preview(request.paths[0], options);
    auto assets = gather(invocation, request, progress);
    if (!assets.value) return {{}, std::move(assets.diagnostics)};
    if (request.report) {
        auto problems = measure_plots(*assets.value, options.threads, &progress);
        if (!problems.empty() || interrupted()) return {{}, std::move(problems)};
    }
    auto page = make_preview(*assets.value, options);
    page.diagnostics.insert(page.diagnostics.begin(), assets.diagnostics.begin(),
                            assets.diagnostics.end());
    return page;
}

ExitCode show(const Invocation& invocation, const PreviewRequest& request, Console& console) {
    const auto start = std::chrono::steady_clock::now();
    auto page = [&] {
        BakeProgress progress("preview", console);
        return make_page(invocation, request, progress);
    }();
    if (interrupted()) return ExitCode::interrupted;
    if (const ExitCode code = console.report(page.diagnostics); !page.value) return code;
    std::vector<std::string> paths;
    if (const ExitCode code = write_preview(*page.value, request, console, paths);
        code != ExitCode::done) {
        return code;
    }
    for (const std::string& path : paths) console.result(path + "\n");
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    console.note(fmt::format("{} pictures in {:.1f} s: open {}\n", paths.size() - 1,
                             elapsed.count(), paths.back()));
    return ExitCode::done;
}

ExitCode run_preview(const Invocation& invocation, Console& console) {
    const auto request = preview_request(invocation);
    if (const ExitCode code = console.report(request.diagnostics); !request.value) return code;
    if (const ExitCode code = check_output(*request.value, console); code != ExitCode::done) {
        return code;
    }
    if (auto problem = text_problem()) {  // pictures are worth having without labels, too
        problem->severity = config::Severity::warning;
        problem->code = "W0302";
        console.report(std::array{*problem});
    }
    if (request.value->watch) return watch_preview(invocation, *request.value, console);
    return show(invocation, *request.value, console);
}

}  // namespace

Command preview_command() {
    return {.name = "preview",
            .brief = "pictures of it",
            .summary = "pictures of a recipe or of baked files, and a page of all of them",
            .arguments = {{.name = "recipe|folder|file",
                           .help = "a recipe, a folder of a bake or sweep, or EXR, VDB, bin files",
                           .repeatable = true}},
            .options = preview_options(),
            .examples = {{"skybake preview earth.toml", "the sky of a recipe: preview/index.html"},
                         {"skybake preview out --sun-elevation 40,5,-4 -o sky",
                          "of what was baked, for three suns"},
                         {"skybake preview cumulus.toml --watch",
                          "a page that follows the recipe while you write it"}},
            .exit_codes = {ExitCode::io, ExitCode::checks},
            .run = run_preview};
}

}  // namespace skybake::cli
