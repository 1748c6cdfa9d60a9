#include "cli/command.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <exception>
#include <new>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "bakers/io/manifest/release.h"
#include "bakers/io/volumes/volume_reader.h"
#include "cli/events.h"
#include "cli/options.h"

namespace skybake::cli {

// This file holds the one table of commands, and runs the program.

// --- What is given ------------------------------------------------------------------------------

void Invocation::declare(const OptionRow& option) {
    Entry& declared = options_[option.name];
    if (!option.fallback.empty()) declared.texts = {std::string(option.fallback)};
}

void Invocation::give(std::string_view name, std::vector<std::string> texts) {
    options_.at(name) = {true, std::move(texts)};
}

const Invocation::Entry& Invocation::entry(std::string_view name) const {
    const auto found = options_.find(name);
    if (found != options_.end()) return found->second;
    throw std::logic_error(fmt::format("the command does not declare --{}", name));
}

// --- Tables -------------------------------------------------------------------------------------

// Each of these is defined in NAME_command.cpp.
Command init_command();
Command check_command();
Command show_command();
Command explain_command();
Command schema_command();
Command plan_command();
Command bake_command();
Command sweep_command();
Command preview_command();
Command report_command();
Command info_command();
Command diff_command();
Command verify_command();
Command cache_command();
Command help_command();

const std::vector<Command>& commands() {
    static const std::vector<Command> table = {
        init_command(), check_command(), show_command(),   explain_command(), schema_command(),
        plan_command(), bake_command(),  sweep_command(),  preview_command(), report_command(),
        info_command(), diff_command(),  verify_command(), cache_command(),   help_command(),
    };
    return table;
}

const std::vector<OptionRow>& global_options() {
    static const std::vector<OptionRow> table = {
        options::help("show this help, or the help of a command"),
        options::version("show the version"),
        options::quiet("print only results, errors and warnings"),
        options::verbose("print the plan of a bake as well"),
        options::json("print results and failures as JSON Lines on stdout"),
        options::color("when to colour messages", "auto"),
        options::diagnostics("how to print errors and warnings", "human"),
    };
    return table;
}

// --- A run --------------------------------------------------------------------------------------

namespace {

// Returns the display that the global options ask for. A global option that could not be understood
// has its default. But a program that asks for JSON gets every mistake as JSON.
Display display_of(const CommandLine& line, std::span<const std::string> words, bool terminal,
                   const ColorEnvironment& environment) {
    const Invocation& invocation = line.invocation;
    Display display;
    display.diagnostics = invocation[options::diagnostics];
    display.color = wants_color(invocation[options::color], terminal, environment);
    display.quiet = invocation[options::quiet];
    display.verbose = invocation[options::verbose];
    const bool misunderstood = !line.diagnostics.empty();
    display.json = invocation[options::json] ||
                   (misunderstood && std::ranges::find(words, "--json") != words.end());
    if (line.command != nullptr) display.command = line.command->name;
    return display;
}

void show_version(Console& console) {
    const std::string text = fmt::format("{} {}\n", tool_name(), release());
    console.result(
        console.json()
            ? event_line({{"event", "version"}, {"name", tool_name()}, {"release", release()}})
            : text);
}

ExitCode answer(const CommandLine& line, bool wordless, Console& console) {
    if (!line.diagnostics.empty()) return console.report(line.diagnostics);
    if (line.invocation[options::help]) {
        show_help(line.command, console);
        return ExitCode::done;
    }
    if (line.invocation[options::version]) {
        show_version(console);
        return ExitCode::done;
    }
    if (line.command != nullptr) return line.command->run(line.invocation, console);
    if (wordless) {
        console.note(short_help());
        return ExitCode::usage;
    }
    return console.report(
        std::vector{usage_error("no command is given", "`skybake --help` lists the commands")});
}

ExitCode report_exception(Console& console, const std::exception& exception) {
    const bool wants_memory = dynamic_cast<const std::bad_alloc*>(&exception) != nullptr;
    return console.report(std::array{
        is_want_of_threads(exception) ? diagnosis("E0306", std::string(want_of_threads))
        : wants_memory                ? diagnosis("E0307", kWantOfMemory)
                       : diagnosis("E0500", fmt::format("internal error: {}", exception.what()))});
}

}  // namespace

ExitCode run(std::span<const std::string> words, Sink out, Sink error,
             const ColorEnvironment& environment) {
    config::set_volume_probe(read_volume_shape);
    const bool terminal = error.terminal;
    const CommandLine line = parse_arguments(words, commands(), global_options());
    Console console(std::move(out), std::move(error),
                    display_of(line, words, terminal, environment));
    ExitCode code = ExitCode::internal;
    try {
        code = answer(line, words.empty(), console);
    } catch (const std::exception& exception) {
        code = report_exception(console, exception);
    }
    return console.finish(code);
}

}  // namespace skybake::cli
