// The JSON Schema of a recipe, for editors that complete and check TOML.
#pragma once

#include <string>

namespace skybake::config {

// Draft-07, the newest that TOML editors know, indented, ending in a newline. It allows all that a
// recipe may contain; whether a recipe is whole depends on its preset and its includes too, so that
// the schema asks for no key. Sums across keys are the decoder's business.
std::string recipe_schema();

}  // namespace skybake::config
