// From the merged tree of a recipe to what its [sweep] varies.
#pragma once

#include "config/fields/section_decoder.h"
#include "config/sweep/sweep.h"

namespace skybake::config {

// Reads [sweep]; without one nothing varies. Axes stand in the order in which the sources name
// them. The sweep is whole only if no error was reported: E0102 for paths that no key has, E0135 to
// E0137, and those of values that no variant could be made of. The decoder gets the values of
// [sweep] as they are written.
Sweep decode_sweep(const Table& root, Decoder& decoder);

}  // namespace skybake::config
