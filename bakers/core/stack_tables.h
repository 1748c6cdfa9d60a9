// Several tables of one size in one file, below each other.
#pragma once

#include <vector>

#include "bakers/core/baked_table.h"

namespace skybake {

// The first part stands at v = 0, part k of n at v from k / n to (k + 1) / n. The first one's texts
// speak for all; range counts, probes and certificates are those of all parts together. At least
// one part; all of the same size, channels and pixel type.
BakedTable stack_tables(std::vector<BakedTable> parts);

}  // namespace skybake
