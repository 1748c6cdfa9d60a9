// skybake explain: says what a key or a diagnostic code means.
#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/console.h"
#include "cli/events.h"
#include "cli/options.h"
#include "config/recipe/explain.h"
#include "config/text/key_path.h"
#include "config/text/text.h"

namespace skybake::cli {
namespace {

Diagnostic unknown_name(const std::string& name) {
    const std::vector<std::string> known = config::explained_names();
    const std::vector<std::string_view> names(known.begin(), known.end());
    std::string label = config::did_you_mean(name, names);
    if (label.empty()) label = "`skybake explain` lists all keys";
    return usage_error(
        fmt::format("`{}` is neither a key nor a diagnostic code", config::shorten(name)), label);
}

// Returns the explanation of a name, or of all keys if the name is empty.
std::optional<std::string> explanation_of(const std::string& name) {
    return name.empty() ? config::explain_all_keys() : config::explain(name);
}

ExitCode run_explain(const Invocation& invocation, Console& console) {
    const std::string name = invocation.arguments().empty() ? "" : invocation.arguments()[0];
    const std::optional<std::string> text = explanation_of(name);
    if (!text) return console.report(std::array{unknown_name(name)});
    console.result(console.json()
                       ? event_line({{"event", "explanation"}, {"name", name}, {"text", *text}})
                       : *text);
    return ExitCode::done;
}

}  // namespace

Command explain_command() {
    return {
        .name = "explain",
        .brief = "explain a key or a code",
        .summary = "explain a key of a recipe or the code of a diagnostic",
        .arguments = {{.name = "name",
                       .help = "a key's path or its tail, a table, or a code (default: all keys)",
                       .required = false}},
        .examples = {{"skybake explain atmosphere.layers.aerosol.g", "shows its range and default"},
                     {"skybake explain scale_height", "finds a key without its path"},
                     {"skybake explain noise.shape.channels", "lists the keys of a table"},
                     {"skybake explain E0102", "explains an error and its remedy"}},
        .run = run_explain};
}

}  // namespace skybake::cli
