#include "cli/run.h"

#include <fmt/format.h>

#include <exception>
#include <new>
#include <utility>
#include <vector>

#include "bakers/io/release.h"
#include "cli/commands.h"
#include "cli/help.h"
#include "cli/parse_arguments.h"

namespace skybake::cli {
namespace {

// Global options that could not be understood show themselves in the default way.
Display display_of(const Invocation& invocation, bool terminal, const char* no_color) {
    Display display;
    display.diagnostics =
        diagnostic_format(invocation.value("diagnostics")).value_or(DiagnosticFormat::human);
    display.color = wants_color(invocation.value("color"), terminal, no_color);
    display.quiet = invocation.has("quiet");
    display.verbose = invocation.has("verbose");
    return display;
}

ExitCode answer(const CommandLine& line, bool wordless, Console& console) {
    if (!line.diagnostics.empty()) return console.report(line.diagnostics);
    if (line.invocation.has("help")) {
        console.result(line.command != nullptr ? command_help(*line.command)
                                               : global_help(commands(), global_options()));
        return ExitCode::done;
    }
    if (line.invocation.has("version")) {
        console.result(fmt::format("{} {}\n", tool_name(), release()));
        return ExitCode::done;
    }
    if (line.command != nullptr) return line.command->run(line.invocation, console);
    if (wordless) {
        console.note(short_help(commands()));
        return ExitCode::usage;
    }
    return console.report(
        std::vector{usage_error("a command is missing", "`skybake --help` lists the commands")});
}

ExitCode internal_error(Console& console, const std::string& what) {
    config::Diagnostic diagnostic;
    diagnostic.code = "E0500";
    diagnostic.message = fmt::format("internal error: {}", what);
    console.report({&diagnostic, 1});
    return ExitCode::internal;
}

}  // namespace

ExitCode run(std::span<const std::string> words, Sink out, Sink error, const char* no_color) {
    const bool terminal = error.terminal;
    const CommandLine line = parse_arguments(words, commands(), global_options());
    Console console(std::move(out), std::move(error),
                    display_of(line.invocation, terminal, no_color));
    ExitCode code = ExitCode::internal;
    try {
        code = answer(line, words.empty(), console);
    } catch (const std::bad_alloc&) {
        code = internal_error(console, "the memory does not suffice");
    } catch (const std::exception& exception) {
        code = internal_error(console, exception.what());
    }
    return console.finish(code);
}

}  // namespace skybake::cli
