// A phase function without closed form, as a table: p(nu), nu the cosine between the light's way
// before and after, in 1/sr, is linear in nu between nodes.
//
// Forward and backward halves have `cells` cells each, with nodes at
//
//   1 - nu = (i / cells)^4  in the forward half,   1 + nu = (i / cells)^4  in the backward half,
//
// that is about uniform in the square root of the angle from the pole: a table of 1000 cells tells
// angles of 1e-6 apart at 0 and 180 degrees and 0.2 degrees apart at 90. A lookup is two square
// roots and one interpolation in 1 -+ nu, which keep their digits at the poles. cells is a power of
// two of at most 2^13: (i / cells)^4 then is exact.
//
// The integral over all directions is 1, p being linear in every cell.
#pragma once

#include <functional>
#include <vector>

namespace skybake {

// A scattering angle by 1 - cos and 1 + cos, without cancellation.
struct ScatteringAngle {
    double one_minus = 0;
    double one_plus = 2;
};

struct TabulatedPhase {
    int cells = 0;
    std::vector<double> forward;   // cells + 1 values, 1/sr, positive, from 0 degrees to 90
    std::vector<double> backward;  // from 180 degrees to 90; their last ones are the same
    // The share of light that is scattered between the pole and each node.
    std::vector<double> forward_share, backward_share;
};

// From values at the nodes, all positive, their scale arbitrary. Both have cells + 1 of them.
TabulatedPhase normalised_phase(std::vector<double> forward, std::vector<double> backward);

// p at an angle, 1/sr.
double tabulated_phase_value(const TabulatedPhase& phase, double one_minus_cosine,
                             double one_plus_cosine);

// The Legendre moments chi_0 = 1 ... chi_degree (phase_function.h); chi_1 is the mean cosine.
// Each cell's integral is by Gauss's rule with as many nodes as make it exact to rounding.
std::vector<double> tabulated_moments(const TabulatedPhase& phase, int degree);

double tabulated_mean_cosine(const TabulatedPhase& phase);

// The angle at which `share` in [0, 1) of the light is scattered closer to forward: with `share`
// uniform, distributed as p.
ScatteringAngle sample_tabulated_phase(const TabulatedPhase& phase, double share);

// A function's values, all positive, at many angles at once.
using PhaseAtAngles =
    std::function<std::vector<double>(const std::vector<ScatteringAngle>& angles)>;

struct MeasuredPhase {
    TabulatedPhase phase;
    double error = 0;  // of the interpolation at the cells' middles, relative to the value, largest
};

// The table of a function, scaled to an integral of 1. Cells double until interpolation between
// them is within `bound`, or there are 2^13.
MeasuredPhase make_tabulated_phase(const PhaseAtAngles& values, double bound);

// --- Interpolation -------------------------------------------------------------------------------

// A phase function between the nodes at which a series was summed: uniform in the fourth root of
// 1 - cos (forward half) and 1 + cos (backward half), as in tabulated_phase.h.
//
// Polynomials through the logarithms of six nodes, which keep the phase function positive. It is
// an analytic function of 1 - cos, hence an even one of its root: at the poles nodes are mirrored,
// at 90 degrees the polynomials are one-sided.

// Values from the pole to 90 degrees, of both halves.
struct PhaseHalves {
    std::vector<double> forward, backward;
};

// The largest |after - before| / after of all values.
double largest_difference(const PhaseHalves& before, const PhaseHalves& after);

// The values between neighbours, by interpolation.
PhaseHalves interpolated_middles(const PhaseHalves& nodes);

// Nodes and the values in their middles, in order.
PhaseHalves interleaved(const PhaseHalves& nodes, const PhaseHalves& middles);

class PhaseInterpolation {
  public:
    explicit PhaseInterpolation(const PhaseHalves& nodes);

    std::vector<double> values(const std::vector<ScatteringAngle>& angles) const;

  private:
    PhaseHalves logarithms_;
};

}  // namespace skybake
