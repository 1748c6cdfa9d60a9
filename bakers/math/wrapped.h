// Indices along axes that repeat.
#pragma once

namespace skybake {

// Returns the index within [0, size) that `i` stands for.
inline int wrapped(int i, int size) { return ((i % size) + size) % size; }

}  // namespace skybake
