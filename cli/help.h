// What the program says of itself, made from the tables of commands and options: help, man pages
// and shell completions.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cli/command.h"

namespace skybake::cli {

class Console;

inline constexpr std::string_view program_summary =
    "bakes sky tables, cloud noise and cloud volumes, and measures their errors";

struct ExitCodeWords {
    ExitCode code;
    std::string_view words;
};

// Those of `codes` in the order of their numbers; of an empty list, all.
std::vector<ExitCodeWords> exit_codes(std::span<const ExitCode> codes);

// What an option is for, its choices and its default, in one line.
std::string option_help(const OptionRow& option);

// What `skybake` without a command prints: twelve lines.
std::string short_help(std::span<const Command> commands);

// Prints the help of a command, or of the program where that is null: at most 40 lines.
void show_help(const Command* command, Console& console);

// The sources of skybake(1) and skybake-COMMAND(1).
std::string man_page(std::span<const Command> commands, std::span<const OptionRow> globals,
                     std::span<const Example> examples);
std::string man_page(const Command& command);

enum class Shell { bash, zsh, fish };

// A script that completes commands, options, choices and names of files.
std::string completion(Shell shell, std::span<const Command> commands,
                       std::span<const OptionRow> globals);

}  // namespace skybake::cli
