// A phase function between the nodes at which a series was summed: uniform in the fourth root of
// 1 - cos (forward half) and 1 + cos (backward half), as in tabulated_phase.h.
//
// Polynomials through the logarithms of six nodes, which keep the phase function positive. It is
// an analytic function of 1 - cos, hence an even one of its root: at the poles nodes are mirrored,
// at 90 degrees the polynomials are one-sided.
#pragma once

#include <vector>

#include "bakers/air/particles/tabulated_phase.h"

namespace skybake {

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
