// The JSON Schemas that the program contains.
#pragma once

#include <string_view>

namespace skybake::cli {

// Returns the text of a schema's file by its name, such as "event_schema.json".
std::string_view schema_text(std::string_view name);

}  // namespace skybake::cli
