// Fixed quadratures: over azimuths, along climbs, in the cells of rays, and over zenith angles.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace skybake {

// A quadrature over the azimuth between view and sun. The light is symmetric about azimuth 0.
struct AzimuthRule {
    int count = 0;
    double nodes[8] = {};
    double weights[8] = {};  // their sum is 1
};

// Returns the rule for the whole circle. Its nodes are the cosines of the azimuths (i + 1/2) pi / n
// with n = 1, 2, 4 or 8, which integrate trigonometric polynomials up to degree 2 n - 1 exactly.
const AzimuthRule& full_circle_rule(int count);

// Returns the rule for azimuths from 0 to a bound: the nodes are fractions of that bound. The rule
// is Gauss-Legendre's with at least 4 nodes.
const AzimuthRule& lit_part_rule(int count);

// --- Climbs --------------------------------------------------------------------------------------

// The fixed panels by which the column of an exponential density is integrated
// (optical_depth-inl.h).
//
// On a panel of l scale heights n nodes leave an error of about (l / 4)^(2n) / (2n)! of the density
// at the panel's beginning, so panels may grow as the density falls: 6, 12 and 22 scale heights
// with 12 nodes each leave less than 1e-14, and 4e-18 of the whole lies beyond 40 scale heights.
inline constexpr std::array<double, 3> kClimbPanelEnds = {6, 18, 40};
inline constexpr int kClimbNodes = 12;

struct ClimbRule {
    double nodes[kClimbNodes];         // in (0, 1)
    double half_weights[kClimbNodes];  // sum 1/2
};

const ClimbRule& climb_rule();

// --- Cells ---------------------------------------------------------------------------------------

// The quadrature of one cell of a ray: Gauss's three nodes on [0, 1], their weights, and the
// weights of the integral from 0 to each node.
namespace cell_rule {

inline constexpr std::size_t kGauss = 3;
inline constexpr double kRoot15 = 3.87298334620741688518;
inline constexpr std::array<double, kGauss> kNodes = {0.5 - kRoot15 / 10, 0.5, 0.5 + kRoot15 / 10};
inline constexpr std::array<double, kGauss> kWeights = {5.0 / 18, 8.0 / 18, 5.0 / 18};
inline constexpr std::array<std::array<double, kGauss>, kGauss> kUpTo = {{
    {5.0 / 36, 2.0 / 9 - kRoot15 / 15, 5.0 / 36 - kRoot15 / 30},
    {5.0 / 36 + kRoot15 / 24, 2.0 / 9, 5.0 / 36 - kRoot15 / 24},
    {5.0 / 36 + kRoot15 / 30, 2.0 / 9 + kRoot15 / 15, 5.0 / 36},
}};

}  // namespace cell_rule

// --- Zenith angles -------------------------------------------------------------------------------

// The division of the directions at a point for quadratures over them.

// A range of mu, integrated with nodes that are densest at `from`.
struct ZenithPart {
    double from;
    double to;
    bool below_horizon;
    int nodes;
};

// Returns three parts: below the horizon, the limb (between the horizon and the horizontal), and
// above, with about 2 `zenith_nodes` nodes in all. `horizon` is the horizon's mu, `height` the
// altitude divided by the shell's thickness. Seen from higher up the limb is wider and brighter and
// the sky above it darker. The shares of nodes are those that, among the ones tried, gave Earth's
// table the least error for its cost (tests/benchmarks/README.md).
std::vector<ZenithPart> zenith_parts(double horizon, double height, int zenith_nodes);

}  // namespace skybake
