// The one table of commands.
#pragma once

#include <vector>

#include "cli/command.h"

namespace skybake::cli {

// In the order of a newcomer's day; help shows them so.
const std::vector<Command>& commands();

// Options that every command takes.
const std::vector<Option>& global_options();

// Null where there is none of that name.
const Command* find_command(std::string_view name);

}  // namespace skybake::cli
