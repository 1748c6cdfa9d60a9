#include "cli/bake_selection.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <string>
#include <utility>

#include "bakers/assets/cloud_volume/cloud_inputs.h"
#include "cli/parse_arguments.h"
#include "cli/recipe_argument.h"
#include "config/text/suggest.h"

namespace skybake::cli {
namespace {

using config::Bake;
using config::Diagnostic;
using config::Outcome;

std::optional<int> thread_count_of(const std::string& text) {
    int threads = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), threads);
    const bool whole = error == std::errc() && end == text.data() + text.size();
    if (!whole || threads < 1 || threads > 1024) return std::nullopt;
    return threads;
}

Diagnostic nothing_to_bake() {
    return {config::Severity::error,
            "E0124",
            "the recipe bakes nothing: it has no [bake.*]",
            {},
            "add [bake.transmittance]"};
}

}  // namespace

Option set_option() {
    return {.name = "set",
            .value = "KEY=VALUE",
            .help = "override a value of the recipe",
            .repeatable = true};
}

Option only_option(std::string_view help) {
    return {.name = "only", .value = "NAME", .help = help, .repeatable = true};
}

Option jobs_option(std::string_view help) {
    return {.name = "jobs", .short_name = 'j', .value = "N", .help = help};
}

Outcome<int> jobs_of(const Invocation& invocation) {
    if (!invocation.has("jobs")) return {0, {}};
    const auto threads = thread_count_of(invocation.value("jobs"));
    if (threads) return {*threads, {}};
    return {{},
            {usage_error(fmt::format("`-j` cannot be `{}`", invocation.value("jobs")),
                         "it takes a number of threads from 1 to 1024")}};
}

Outcome<BakeSelection> select_bakes(const Invocation& invocation) {
    auto recipe = recipe_of(invocation);
    Outcome<BakeSelection> outcome;
    outcome.diagnostics = std::move(recipe.diagnostics);
    if (!recipe.value) return outcome;
    const std::vector<Bake>& all = recipe.value->parameters.bakes;

    std::vector<Diagnostic> problems;
    std::vector<std::string_view> names;
    for (const Bake& bake : all) names.push_back(bake.name);
    const std::vector<std::string> only = invocation.values("only");
    for (const std::string& name : only) {
        if (std::find(names.begin(), names.end(), name) != names.end()) continue;
        problems.push_back(usage_error(fmt::format("--only: the recipe has no [bake.{}]", name),
                                       config::did_you_mean(name, names)));
    }
    if (all.empty()) problems.push_back(nothing_to_bake());
    const std::vector<Diagnostic> unreadable = check_maps(recipe.value->parameters);
    problems.insert(problems.end(), unreadable.begin(), unreadable.end());
    const Outcome<int> threads = jobs_of(invocation);
    problems.insert(problems.end(), threads.diagnostics.begin(), threads.diagnostics.end());
    outcome.diagnostics.insert(outcome.diagnostics.end(), problems.begin(), problems.end());
    if (!problems.empty()) return outcome;

    BakeSelection selection;
    for (const Bake& bake : all) {
        const bool wanted =
            only.empty() || std::find(only.begin(), only.end(), bake.name) != only.end();
        if (wanted) selection.bakes.push_back(bake);
    }
    selection.threads = *threads.value;
    selection.recipe = std::move(*recipe.value);
    outcome.value = std::move(selection);
    return outcome;
}

}  // namespace skybake::cli
