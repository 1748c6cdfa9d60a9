// Fixed quadratures: over azimuths, along climbs, in the cells of rays, and over zenith angles.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace skybake {

// Quadratures over the azimuth between view and sun, whose light is symmetric about 0.

struct AzimuthRule {
    int count = 0;
    double nodes[8] = {};
    double weights[8] = {};  // their sum is 1
};

// For the whole circle: nodes are cosines of the azimuths (i + 1/2) pi / n, n = 1, 2, 4 or 8, which
// integrate trigonometric polynomials up to degree 2 n - 1 exactly.
const AzimuthRule& full_circle_rule(int count);

// For azimuths from 0 to a bound: nodes are fractions of it. Gauss-Legendre with at least 4 nodes.
const AzimuthRule& lit_part_rule(int count);

// --- Climbs --------------------------------------------------------------------------------------

// The fixed panels by which the column of an exponential density is integrated
// (optical_depth-inl.h).
//
// On a panel of l scale heights n nodes leave about (l / 4)^(2n) / (2n)! of the density where it
// begins, so panels may grow as the density falls: 6, 12 and 22 scale heights with 12 nodes each
// leave less than 1e-14, and beyond 40 there is 4e-18 of the whole.

inline constexpr std::array<double, 3> kClimbPanelEnds = {6, 18, 40};
inline constexpr int kClimbNodes = 12;

struct ClimbRule {
    double nodes[kClimbNodes];         // in (0, 1)
    double half_weights[kClimbNodes];  // sum 1/2
};

const ClimbRule& climb_rule();

// --- Cells ---------------------------------------------------------------------------------------

// The quadrature of one cell of a ray: Gauss' three nodes on [0, 1], their weights, and the weights
// of the integral from 0 to each node.

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

// How directions at a point are divided for quadratures over them.

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
