// The texts of --help, made from the tables of commands and options.
#pragma once

#include <span>
#include <string>

#include "cli/command.h"

namespace skybake::cli {

// What `skybake` without a command prints: twelve lines.
std::string short_help(std::span<const Command> commands);

// skybake --help: at most 40 lines.
std::string global_help(std::span<const Command> commands, std::span<const Option> global_options);

// skybake COMMAND --help: at most 40 lines.
std::string command_help(const Command& command);

}  // namespace skybake::cli
