// One run of the program, from its words to its exit code.
#pragma once

#include <span>
#include <string>

#include "cli/console.h"
#include "cli/exit_code.h"

namespace skybake::cli {

// `words` are those behind the program's name. Exceptions are mistakes of the program's own and end
// here as `internal`.
ExitCode run(std::span<const std::string> words, Sink out, Sink error,
             const ColorEnvironment& environment = {});

}  // namespace skybake::cli
