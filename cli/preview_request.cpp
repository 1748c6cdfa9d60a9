#include "cli/preview_request.h"

#include <fmt/format.h>

#include <string>

#include "bakers/io/formats/format.h"
#include "bakers/io/manifest/manifest.h"
#include "bakers/preview/load_sweep.h"
#include "cli/bake_selection.h"
#include "cli/parse_arguments.h"
#include "cli/preview_options.h"
#include "cli/recipe_argument.h"
#include "config/text/key_path.h"

namespace skybake::cli {
namespace {

namespace fs = std::filesystem;
using config::Diagnostic;
using Subject = PreviewRequest::Subject;

Subject subject_of(const fs::path& path) {
    std::error_code error;
    if (is_sweep_folder(path)) return Subject::sweep;
    if (fs::is_directory(path, error) || path.filename() == manifest_name) return Subject::folder;
    const std::string extension = path.extension().string();
    const bool baked = extension.size() > 1 && find_format(extension.substr(1)) != nullptr;
    return baked ? Subject::files : Subject::recipe;
}

// Recipes have options that what is baked already has not.
void check_combination(const Invocation& invocation, const PreviewRequest& request,
                       std::vector<Diagnostic>& problems) {
    if (request.paths.size() > 1 && request.subject != Subject::files) {
        problems.push_back(usage_error("preview takes one recipe or one folder at a time",
                                       "it takes several files: a.exr b.exr"));
    }
    if (request.watch && is_standard_input(request.paths[0].string())) {
        problems.push_back(usage_error("--watch needs a recipe in a file",
                                       "standard input cannot be read a second time"));
    }
    if (request.subject == Subject::sweep && request.report) {
        problems.push_back(
            usage_error("--report does not work with a sweep",
                        "each of its variants is a folder: preview one of those with --report"));
    }
    if (request.subject == Subject::recipe) return;
    for (const char* option : {"set", "only", "watch"}) {
        if (!invocation.has(option)) continue;
        problems.push_back(usage_error(
            fmt::format("--{} works only with a recipe", option),
            fmt::format("`{}` is baked already", config::printable(request.paths[0].string()))));
    }
}

}  // namespace

config::Outcome<PreviewRequest> preview_request(const Invocation& invocation) {
    PreviewRequest request;
    for (const std::string& path : invocation.arguments()) request.paths.emplace_back(path);
    request.subject = subject_of(request.paths[0]);
    for (const fs::path& path : request.paths) {
        if (subject_of(path) != request.subject) request.subject = Subject::recipe;
    }
    request.output = invocation.value("output");
    request.force = invocation.has("force");
    request.report = invocation.has("report");
    request.watch = invocation.has("watch");

    config::Outcome<PreviewRequest> outcome;
    std::vector<Diagnostic>& problems = outcome.diagnostics;
    if (request.output.empty()) problems.push_back(usage_error("-o: the folder's name is empty"));
    if (request.watch && request.report) {
        problems.push_back(usage_error("--watch and --report exclude each other",
                                       "a report takes too long to follow every save"));
    }
    check_combination(invocation, request, problems);
    request.options = read_preview_options(invocation, problems);
    request.draft_edge = read_draft_edge(invocation, problems).value_or(request.draft_edge);
    if (invocation.has("draft") && !request.watch) {
        problems.push_back(
            usage_error("--draft works only with --watch", "other previews make no drafts"));
    }
    const config::Outcome<int> threads = jobs_of(invocation);
    problems.insert(problems.end(), threads.diagnostics.begin(), threads.diagnostics.end());
    if (!problems.empty()) return outcome;
    request.options.threads = *threads.value;
    outcome.value = std::move(request);
    return outcome;
}

}  // namespace skybake::cli
