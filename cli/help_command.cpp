// skybake help: the help of the program or of a command.
#include "cli/help_command.h"

#include <array>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/commands.h"
#include "cli/console.h"
#include "cli/event_line.h"
#include "cli/help.h"
#include "cli/parse_arguments.h"

namespace skybake::cli {
namespace {

ExitCode run_help(const Invocation& invocation, Console& console) {
    const Command* command = nullptr;
    if (!invocation.arguments().empty()) {
        const std::string& name = invocation.arguments()[0];
        command = find_command(name);
        if (command == nullptr) {
            return console.report(std::array{unknown_command(name, commands())});
        }
    }
    show_help(command, console);
    return ExitCode::done;
}

}  // namespace

void show_help(const Command* command, Console& console) {
    const std::string text =
        command != nullptr ? command_help(*command) : global_help(commands(), global_options());
    console.result(console.display().json ? event_line({{"event", "help"}, {"text", text}}) : text);
}

Command help_command() {
    return {.name = "help",
            .brief = "show help",
            .summary = "show this help, or the help of a command",
            .arguments = {{.name = "command",
                           .help = "the command to explain (default: all commands, one line each)",
                           .required = false}},
            .examples = {{"skybake help bake", "shows what `skybake bake --help` shows"}},
            .run = run_help};
}

}  // namespace skybake::cli
