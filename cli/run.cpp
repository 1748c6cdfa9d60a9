#include "cli/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <new>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "bakers/io/manifest/release.h"
#include "cli/commands.h"
#include "cli/event_line.h"
#include "cli/help.h"
#include "cli/help_command.h"
#include "cli/parse_arguments.h"

namespace skybake::cli {
namespace {

// Global options that could not be understood show themselves in the default way; but a program
// that asks for JSON is to read of every mistake.
Display display_of(const CommandLine& line, std::span<const std::string> words, bool terminal,
                   const ColorEnvironment& environment) {
    const Invocation& invocation = line.invocation;
    Display display;
    display.diagnostics =
        diagnostic_format(invocation.value("diagnostics")).value_or(DiagnosticFormat::human);
    display.color = wants_color(invocation.value("color"), terminal, environment);
    display.quiet = invocation.has("quiet");
    display.verbose = invocation.has("verbose");
    const bool misunderstood = !line.diagnostics.empty();
    display.json = invocation.has("json") || (misunderstood && std::find(words.begin(), words.end(),
                                                                         "--json") != words.end());
    if (line.command != nullptr) display.command = line.command->name;
    return display;
}

void show_version(bool json, Console& console) {
    const std::string text = fmt::format("{} {}\n", tool_name(), release());
    console.result(
        json ? event_line({{"event", "version"}, {"name", tool_name()}, {"release", release()}})
             : text);
}

ExitCode answer(const CommandLine& line, bool wordless, Console& console) {
    if (!line.diagnostics.empty()) return console.report(line.diagnostics);
    if (line.invocation.has("help")) {
        show_help(line.command, console);
        return ExitCode::done;
    }
    if (line.invocation.has("version")) {
        show_version(console.display().json, console);
        return ExitCode::done;
    }
    if (line.command != nullptr) return line.command->run(line.invocation, console);
    if (wordless) {
        console.note(short_help(commands()));
        return ExitCode::usage;
    }
    return console.report(
        std::vector{usage_error("no command is given", "`skybake --help` lists the commands")});
}

ExitCode internal_error(Console& console, const std::string& what) {
    config::Diagnostic diagnostic;
    diagnostic.code = "E0500";
    diagnostic.message = fmt::format("internal error: {}", what);
    console.report({&diagnostic, 1});
    return ExitCode::internal;
}

}  // namespace

ExitCode run(std::span<const std::string> words, Sink out, Sink error,
             const ColorEnvironment& environment) {
    const bool terminal = error.terminal;
    const CommandLine line = parse_arguments(words, commands(), global_options());
    Console console(std::move(out), std::move(error),
                    display_of(line, words, terminal, environment));
    ExitCode code = ExitCode::internal;
    try {
        code = answer(line, words.empty(), console);
    } catch (const std::bad_alloc&) {
        code = internal_error(console, "there is not enough memory");
    } catch (const std::exception& exception) {
        code = internal_error(console, exception.what());
    }
    return console.finish(code);
}

}  // namespace skybake::cli
