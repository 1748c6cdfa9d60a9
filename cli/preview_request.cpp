#include "cli/preview_request.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <string>
#include <string_view>

#include "bakers/io/manifest.h"
#include "bakers/io/spelling.h"
#include "bakers/preview/load_sweep.h"
#include "cli/bake_selection.h"
#include "cli/parse_arguments.h"
#include "cli/recipe_argument.h"
#include "config/key_path.h"
#include "config/units.h"

namespace skybake::cli {
namespace {

namespace fs = std::filesystem;
using config::Diagnostic;
using config::Dimension;
using Subject = PreviewRequest::Subject;

Subject subject_of(const fs::path& path) {
    std::error_code error;
    if (is_sweep_folder(path)) return Subject::sweep;
    if (fs::is_directory(path, error) || path.filename() == manifest_name) return Subject::folder;
    const std::string extension = path.extension().string();
    const bool baked = extension.size() > 1 && volume_format_of(extension.substr(1)).has_value();
    return baked ? Subject::files : Subject::recipe;
}

// A number, or a quantity of that dimension, in base units.
std::optional<double> value_of(std::string_view text, Dimension dimension) {
    const auto parsed = config::parse_quantity(text);
    const auto* quantity = std::get_if<config::Quantity>(&parsed);
    if (quantity == nullptr || quantity->dimension != dimension) return std::nullopt;
    return quantity->value;
}

// "20" and "20 deg" alike.
std::optional<double> degrees_of(std::string_view text) {
    if (const auto number = value_of(text, Dimension::number)) return number;
    const auto radians = value_of(text, Dimension::angle);
    if (!radians) return std::nullopt;
    return *radians * 180 / std::numbers::pi;
}

Diagnostic bad_value(std::string_view option, std::string_view text, std::string label) {
    return usage_error(fmt::format("{}: `{}` will not do", option, config::printable(text)),
                       std::move(label));
}

// Each value may hold several, with commas between.
void read_elevations(const Invocation& invocation, PreviewOptions& options,
                     std::vector<Diagnostic>& problems) {
    for (const std::string& list : invocation.values("sun-elevation")) {
        for (std::size_t at = 0; at <= list.size();) {
            const std::size_t comma = std::min(list.find(',', at), list.size());
            const std::string_view text = std::string_view(list).substr(at, comma - at);
            const auto elevation = degrees_of(text);
            if (elevation && *elevation >= -90 && *elevation <= 90) {
                options.sun_elevations_deg.push_back(*elevation);
            } else {
                problems.push_back(
                    bad_value("--sun-elevation", text, "degrees in [-90, 90]: 40, 5, -4"));
            }
            at = comma + 1;
        }
    }
}

void read_exposure(const Invocation& invocation, PreviewOptions& options,
                   std::vector<Diagnostic>& problems) {
    if (!invocation.has("exposure")) return;
    const std::string text = invocation.value("exposure");
    const auto stops = value_of(text, Dimension::number);
    constexpr double most_stops = 32;  // beyond, every pixel is black or white
    if (stops && *stops >= -most_stops && *stops <= most_stops) {
        options.exposure_stops = *stops;
    } else {
        problems.push_back(bad_value("--exposure", text, "stops in [-32, 32]: 4, -1.5"));
    }
}

void read_altitude(const Invocation& invocation, PreviewOptions& options,
                   std::vector<Diagnostic>& problems) {
    if (!invocation.has("altitude")) return;
    const std::string text = invocation.value("altitude");
    const auto meters = value_of(text, Dimension::length);
    if (meters && *meters >= 0) {
        options.altitude_m = *meters;
    } else {
        problems.push_back(bad_value("--altitude", text, "a length from 0 on, such as 2km"));
    }
}

// Recipes have options that what is baked already has not.
void check_combination(const Invocation& invocation, const PreviewRequest& request,
                       std::vector<Diagnostic>& problems) {
    if (request.paths.size() > 1 && request.subject != Subject::files) {
        problems.push_back(usage_error("one recipe or one folder at a time",
                                       "several files are possible: a.exr b.exr"));
    }
    if (request.watch && is_standard_input(request.paths[0].string())) {
        problems.push_back(usage_error("--watch needs a recipe in a file",
                                       "standard input cannot be read a second time"));
    }
    if (request.subject == Subject::sweep && request.report) {
        problems.push_back(usage_error("--report is not for sweeps",
                                       "its variants are folders: one of them may be reported on"));
    }
    if (request.subject == Subject::recipe) return;
    for (const char* option : {"set", "only", "watch"}) {
        if (!invocation.has(option)) continue;
        problems.push_back(usage_error(
            fmt::format("--{} is for recipes", option),
            fmt::format("`{}` is baked already", config::printable(request.paths[0].string()))));
    }
}

}  // namespace

std::vector<Option> preview_options() {
    return {{.name = "output",
             .short_name = 'o',
             .value = "FOLDER",
             .help = "where index.html and its pictures go",
             .fallback = "preview"},
            set_option(),
            only_option("show [bake.NAME] alone"),
            {.name = "sun-elevation",
             .value = "DEGREES",
             .help = "of skies and clouds, with commas between",
             .repeatable = true},
            {.name = "exposure", .value = "STOPS", .help = "fixed: 0 is 1 (default: chosen)"},
            {.name = "altitude",
             .value = "LENGTH",
             .help = "of the camera under the sky (default 200m)"},
            {.name = "report", .help = "measure and plot speed against error, too"},
            {.name = "watch", .help = "follow the recipe: drafts, at every save, until Ctrl-C"},
            jobs_option("threads; pictures do not depend on it (default: all)"),
            {.name = "force", .help = "overwrite files that no preview has made"}};
}

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
                                       "a report takes longer than a glance"));
    }
    check_combination(invocation, request, problems);
    read_elevations(invocation, request.options, problems);
    read_exposure(invocation, request.options, problems);
    read_altitude(invocation, request.options, problems);
    const config::Outcome<int> threads = jobs_of(invocation);
    problems.insert(problems.end(), threads.diagnostics.begin(), threads.diagnostics.end());
    if (!problems.empty()) return outcome;
    request.options.threads = *threads.value;
    outcome.value = std::move(request);
    return outcome;
}

}  // namespace skybake::cli
