// Phase functions without a closed form, as tables: p(nu) in 1/sr, nu the cosine of the angle
// between the incoming and outgoing direction, is linear in nu between nodes. Also the
// interpolation from which such tables are made.
//
// The forward and the backward half have `cells` cells each, with nodes at
//
//   1 - nu = (i / cells)^4  in the forward half,   1 + nu = (i / cells)^4  in the backward half,
//
// which is about uniform in the square root of the angle from the pole: a table of 1000 cells
// distinguishes angles 1e-6 apart at 0 and 180 degrees and 0.2 degrees apart at 90. A lookup takes
// two square roots and one interpolation in 1 -+ nu, which keep their digits at the poles. cells is
// a power of two of at most 2^13, so that (i / cells)^4 is exact.
//
// The integral over all directions is 1 for p linear in every cell.
#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace skybake {

// A scattering angle, given as 1 - cos and 1 + cos, which avoids cancellation.
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

// Makes a table from values at the nodes, which are positive and have an arbitrary scale. Both
// vectors have cells + 1 values.
TabulatedPhase normalised_phase(std::vector<double> forward, std::vector<double> backward);

// One phase function of several, and its weight, which is above 0.
struct WeightedPhase {
    double weight = 0;
    std::shared_ptr<const TabulatedPhase> phase;
};

// Returns the weighted mean of phase functions, of which there is at least one:
// exactly, since the nodes of the finest table are nodes of all or lie on their
// lines. One alone is returned itself.
std::shared_ptr<const TabulatedPhase> mixed_phase(std::span<const WeightedPhase> phases);

// Returns p at an angle, in 1/sr.
double tabulated_phase_value(const TabulatedPhase& phase, double one_minus_cosine,
                             double one_plus_cosine);

// Returns the Legendre moments chi_0 = 1 to chi_degree (phase_function.h); chi_1 is the mean
// cosine. Each cell is integrated by Gauss's rule with as many nodes as make the integral exact to
// rounding.
std::vector<double> tabulated_moments(const TabulatedPhase& phase, int degree);

// Returns the scattering angle below which `share` in [0, 1) of the light is scattered. For a
// uniformly distributed `share` the angle is distributed as p.
ScatteringAngle sample_tabulated_phase(const TabulatedPhase& phase, double share);

// Computes a function's values, all positive, at many angles at once.
using PhaseAtAngles =
    std::function<std::vector<double>(const std::vector<ScatteringAngle>& angles)>;

struct MeasuredPhase {
    TabulatedPhase phase;
    double error = 0;  // largest relative error of the interpolation at the middles of cells
};

// Makes the table of a function, scaled to an integral of 1. The number of cells doubles until
// interpolation is within `bound` or there are 2^13.
MeasuredPhase make_tabulated_phase(const PhaseAtAngles& values, double bound);

// --- Interpolation -------------------------------------------------------------------------------

// Interpolation of a phase function between the nodes at which a series was summed. The nodes are
// uniform in the fourth root of 1 - cos (forward half) and of 1 + cos (backward half), as above.
//
// The interpolating polynomials run through the logarithms of six nodes, which keeps the phase
// function positive. It is an analytic function of 1 - cos, hence an even function of that root:
// nodes are mirrored at the poles, and at 90 degrees the polynomials are one-sided.

// The values of both halves, each from its pole to 90 degrees.
struct PhaseHalves {
    std::vector<double> forward, backward;
};

inline double relative_change(double before, double after) {
    return std::fabs(after - before) / after;
}

// Returns the largest relative_change of all values.
double largest_difference(const PhaseHalves& before, const PhaseHalves& after);

// Returns the values halfway between neighbouring nodes, by interpolation.
PhaseHalves interpolated_middles(const PhaseHalves& nodes);

// Returns the nodes and the values between them, in order.
PhaseHalves interleaved(const PhaseHalves& nodes, const PhaseHalves& middles);

class PhaseInterpolation {
  public:
    explicit PhaseInterpolation(const PhaseHalves& nodes);

    std::vector<double> values(const std::vector<ScatteringAngle>& angles) const;

  private:
    PhaseHalves logarithms_;
};

}  // namespace skybake
