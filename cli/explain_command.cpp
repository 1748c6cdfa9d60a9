// skybake explain: what a key or a diagnostic code means.
#include <fmt/format.h>

#include <array>
#include <string>
#include <vector>

#include "cli/command.h"
#include "cli/console.h"
#include "cli/parse_arguments.h"
#include "config/explain.h"
#include "config/key_path.h"
#include "config/suggest.h"

namespace skybake::cli {
namespace {

config::Diagnostic unknown_name(const std::string& name) {
    const std::vector<std::string> known = config::explained_names();
    const std::vector<std::string_view> names(known.begin(), known.end());
    std::string label = config::did_you_mean(name, names);
    if (label.empty()) label = "`skybake explain` lists all keys";
    return usage_error(fmt::format("`{}` is no key and no diagnostic code", config::shorten(name)),
                       label);
}

ExitCode run_explain(const Invocation& invocation, Console& console) {
    if (invocation.arguments().empty()) {
        console.result(config::explain_all_keys());
        return ExitCode::done;
    }
    const std::string& name = invocation.arguments()[0];
    const std::optional<std::string> text = config::explain(name);
    if (!text) return console.report(std::array{unknown_name(name)});
    console.result(*text);
    return ExitCode::done;
}

}  // namespace

Command explain_command() {
    return {
        .name = "explain",
        .brief = "a key or a code",
        .summary = "say what a key or a diagnostic code means",
        .arguments = {{.name = "name",
                       .help = "a key's path or its tail, a table, or a code; left out: all keys",
                       .required = false}},
        .examples = {{"skybake explain atmosphere.layers.mie.g", "unit, range, default, source"},
                     {"skybake explain scale_height", "the same by the key alone"},
                     {"skybake explain noise.shape.channels", "the keys of a noise's channels"},
                     {"skybake explain E0102", "an error, and how to put it right"}},
        .run = run_explain};
}

}  // namespace skybake::cli
