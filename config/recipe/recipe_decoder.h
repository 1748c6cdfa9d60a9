// This header turns the merged tree of a recipe into its parameters.
#pragma once

#include "config/fields/section_decoder.h"
#include "config/sections/parameters.h"
#include "config/text/value_tree.h"

namespace skybake::config {

// The parameters are complete only if no error was reported. `source` is the place that errors
// about missing sections point to.
Parameters decode_recipe(const Table& root, const Source& source, Decoder& decoder);

}  // namespace skybake::config
