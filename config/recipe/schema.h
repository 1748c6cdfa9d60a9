// This header makes the JSON Schema of a recipe, for editors that complete and check TOML.
#pragma once

#include <string>

namespace skybake::config {

// Returns a schema of Draft-07, the newest that TOML editors know. The text is indented and ends in
// a newline. It allows everything that a recipe may contain. It requires no key, because the preset
// and the includes of a recipe may give any key. The decoder, not the schema, checks rules across
// keys.
std::string recipe_schema();

}  // namespace skybake::config
