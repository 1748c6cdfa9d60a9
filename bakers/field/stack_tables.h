// Several tables of one size in one file, below each other.
#pragma once

#include <vector>

#include "bakers/field/baked_table.h"
#include "bakers/field/make_probe.h"

namespace skybake {

// The first part stands at v = 0, part k of n at v from k / n to (k + 1) / n. The first one's texts
// speak for all; range counts and certificates are those of all parts together, and probes are
// chosen anew, some of each part, from its space. At least one part; all of the same size, channels
// and pixel type. E0407; no value and no diagnostics after an interruption.
config::Outcome<BakedTable> stack_tables(std::vector<BakedTable> parts,
                                         std::vector<ProbeSpace> spaces,
                                         const BakeOptions& options);

}  // namespace skybake
