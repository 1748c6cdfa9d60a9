// From the merged tree of a recipe to its parameters.
#pragma once

#include <string>

#include "config/fields/section_decoder.h"
#include "config/sections/parameters.h"
#include "config/text/value_tree.h"

namespace skybake::config {

// The parameters are whole only if no error was reported. `name` is the recipe's, for what is
// missing altogether.
Parameters decode_recipe(const Table& root, const Source& source, Decoder& decoder);

}  // namespace skybake::config
