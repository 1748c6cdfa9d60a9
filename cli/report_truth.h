// skybake report --truth: the sky of a recipe by each way to multiple scattering, against path
// tracing.
#pragma once

#include "cli/command.h"

namespace skybake::cli {

class Console;

ExitCode report_truth(const Invocation& invocation, Console& console);

}  // namespace skybake::cli
