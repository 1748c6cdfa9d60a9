// skybake preview: pictures of recipes and of baked files, and one page of all of them.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <chrono>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bakers/plot/label.h"
#include "bakers/preview/bake_assets.h"
#include "bakers/preview/load_assets.h"
#include "bakers/preview/make_preview.h"
#include "bakers/preview/pictures/report_plots.h"
#include "bakers/preview/sweep_preview.h"
#include "bakers/preview/unused_options.h"
#include "cli/bake_progress.h"
#include "cli/bake_selection.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/event_line.h"
#include "cli/interrupt.h"
#include "cli/preview_options.h"
#include "cli/preview_output.h"
#include "cli/preview_request.h"
#include "cli/watch_preview.h"

namespace skybake::cli {
namespace {

using config::Outcome;
using Subject = PreviewRequest::Subject;

// Options that no picture will use are told before anything is baked.
Outcome<PreviewAssets> bake_recipe(const Invocation& invocation, PreviewRequest& request,
                                   StageProgress& progress) {
    auto selection = select_bakes(invocation);
    if (!selection.value) return {{}, std::move(selection.diagnostics)};
    const std::vector<config::Bake>& bakes = selection.value->bakes;
    const LitPictures lit = lit_pictures_of(bakes);
    auto unused = unused_options(lit, request.options);
    if (!unused.empty()) return {{}, std::move(unused)};
    const BakeStages stages = {&progress,
                               static_cast<int>(bakes.size()) + picture_stages(bakes.size(), lit)};
    request.options.stages_before = static_cast<int>(bakes.size());
    auto assets =
        bake_assets(selection.value->recipe, bakes, request.paths[0].filename().string(),
                    {selection.value->threads, Certification::quick, &progress}, nullptr, stages);
    assets.diagnostics.insert(assets.diagnostics.begin(), selection.diagnostics.begin(),
                              selection.diagnostics.end());
    return assets;
}

Outcome<PreviewAssets> gather(const Invocation& invocation, PreviewRequest& request,
                              StageProgress& progress) {
    if (request.subject == Subject::recipe) return bake_recipe(invocation, request, progress);
    if (request.subject == Subject::folder) return load_folder(request.paths[0]);
    return load_files(request.paths);
}

// No value and no errors: the user has interrupted.
Outcome<PreviewPage> make_page(const Invocation& invocation, PreviewRequest request,
                               StageProgress& progress) {
    PreviewOptions& options = request.options;
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

// The page comes last among the paths.
std::string previewed_event(std::vector<std::string> paths, double seconds) {
    const std::string page = paths.back();
    paths.pop_back();
    return event_line(
        {{"event", "previewed"}, {"page", page}, {"pictures", paths}, {"seconds", seconds}});
}

ExitCode show(const Invocation& invocation, const PreviewRequest& request, Console& console) {
    const auto start = std::chrono::steady_clock::now();
    auto page = [&] {
        BakeProgress progress("preview", console);
        return make_page(invocation, request, progress);
    }();
    if (interrupted()) {
        console.note("interrupted; nothing was written\n");
        return ExitCode::interrupted;
    }
    if (const ExitCode code = console.report(page.diagnostics); !page.value) return code;
    std::vector<std::string> paths;
    if (const ExitCode code = write_preview(*page.value, request, console, paths);
        code != ExitCode::done) {
        return code;
    }
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    console.result(console.display().json ? previewed_event(paths, elapsed.count())
                                          : fmt::format("{}\n", fmt::join(paths, "\n")));
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
    return {
        .name = "preview",
        .brief = "make pictures of it",
        .summary = "make pictures of a recipe or of baked files, and a page that shows them",
        .arguments = {{.name = "recipe|folder|file",
                       .help = "a recipe, a folder of a bake or sweep, or EXR, VDB, bin files",
                       .repeatable = true}},
        .options = preview_options(),
        .examples = {{"skybake preview earth.toml", "shows a recipe's sky in preview/index.html"},
                     {"skybake preview out --sun-elevation 40,5,-4 -o sky",
                      "shows baked files under three suns"},
                     {"skybake preview cumulus.toml --watch",
                      "follows the recipe while you write it"}},
        .exit_codes = {ExitCode::io, ExitCode::checks},
        .run = run_preview};
}

}  // namespace skybake::cli
