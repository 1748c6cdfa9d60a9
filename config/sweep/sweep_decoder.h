// This header reads what the [sweep] of a recipe varies.
#pragma once

#include "config/fields/section_decoder.h"
#include "config/sweep/sweep.h"

namespace skybake::config {

// Reads [sweep] from the merged tree of a recipe. Without [sweep] nothing varies. The axes stand in
// the order in which the sources name them. The sweep is complete only if no error was reported.
// Errors are E0102 for paths that no key has, E0135 to E0137, and the errors of values that no
// variant could be made of. The decoder receives the values of [sweep] as they are written.
Sweep decode_sweep(const Table& root, Decoder& decoder);

}  // namespace skybake::config
