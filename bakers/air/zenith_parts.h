// How directions at a point are divided for quadratures over them.
#pragma once

#include <vector>

namespace skybake {

// A range of mu, integrated with nodes that are densest at `from`.
struct ZenithPart {
    double from;
    double to;
    bool below_horizon;
    int nodes;
};

// Below the horizon, the limb (between the horizon and the horizontal) and above; about 2
// `zenith_nodes` in all. `horizon` is its mu, `height` the altitude over the shell's thickness.
// Seen from higher up the limb is wider and brighter and the sky above it darker. The shares are
// those that gave Earth's table the least error for its cost among the ones tried
// (tests/benchmarks/README.md).
std::vector<ZenithPart> zenith_parts(double horizon, double height, int zenith_nodes);

}  // namespace skybake
