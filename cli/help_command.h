// What `skybake help`, `skybake --help` and `skybake COMMAND --help` print.
#pragma once

#include "cli/command.h"

namespace skybake::cli {

// The help of a command, or of the program where it is null, to stdout.
void show_help(const Command* command, Console& console);

}  // namespace skybake::cli
