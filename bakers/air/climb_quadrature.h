// The fixed panels by which the column of an exponential density is integrated
// (optical_depth-inl.h).
//
// On a panel of l scale heights n nodes leave about (l / 4)^(2n) / (2n)! of the density where it
// begins, so panels may grow as the density falls: 6, 12 and 22 scale heights with 12 nodes each
// leave less than 1e-14, and beyond 40 there is 4e-18 of the whole.
#pragma once

#include <array>

namespace skybake {

inline constexpr std::array<double, 3> kClimbPanelEnds = {6, 18, 40};
inline constexpr int kClimbNodes = 12;

struct ClimbRule {
    double nodes[kClimbNodes];         // in (0, 1)
    double half_weights[kClimbNodes];  // sum 1/2
};

const ClimbRule& climb_rule();

}  // namespace skybake
