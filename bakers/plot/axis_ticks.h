// Where the ticks of an axis are, and what stands beside them.
#pragma once

#include <string>
#include <vector>

#include "bakers/plot/chart.h"

namespace skybake {

struct AxisTick {
    double t = 0;  // along the axis, in [0, 1]
    double value = 0;
    std::string label;
};

// Round numbers at least `gap` apart along the axis, ascending in t. Where the axis is stretched,
// finer ones stand between the coarse ones. None on an axis whose value does not change or is not
// finite.
std::vector<AxisTick> axis_ticks(const ChartAxis& axis, double gap);

// A number as people write it: "0.25", "−5", "2×10⁻⁵".
std::string number_label(double value);

}  // namespace skybake
