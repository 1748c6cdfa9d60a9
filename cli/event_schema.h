// The form of the lines that `bake --json` prints: event_schema.json.
#pragma once

#include <string_view>

namespace skybake::cli {

std::string_view event_schema();

}  // namespace skybake::cli
