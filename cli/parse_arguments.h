// From the words of the command line to a command and its options.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "cli/command.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake::cli {

struct CommandLine {
    const Command* command = nullptr;             // null where none was named
    Invocation invocation;                        // the command's options and the global ones
    std::vector<config::Diagnostic> diagnostics;  // E0001
};

// `words` are those behind the program's name. Options may stand anywhere after the command, global
// ones before it too; "--" ends them. With --help or --version nothing else need be complete.
CommandLine parse_arguments(std::span<const std::string> words, std::span<const Command> commands,
                            std::span<const Option> global_options);

// E0001 with the nearest name, if one is near.
config::Diagnostic unknown_command(const std::string& name, std::span<const Command> commands);

// A diagnostic about the command line.
config::Diagnostic usage_error(std::string message, std::string label = {});

}  // namespace skybake::cli
