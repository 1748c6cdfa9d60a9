// Axes of charts.
#pragma once

#include <cmath>

#include "bakers/plot/axis.h"

namespace skybake {

inline ChartAxis axis(double first, double last, double power = 1,
                      AxisTicks ticks = AxisTicks::decimal) {
    return {"axis", [=](double t) { return first + std::pow(t, power) * (last - first); }, ticks};
}

}  // namespace skybake
