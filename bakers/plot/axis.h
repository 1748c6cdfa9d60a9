// The axes of charts: their range, the place of a value on them, and their ticks and labels.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace skybake {

enum class AxisTicks {
    decimal,      // at 1, 2 and 5 times powers of ten
    angles,       // at 90, 30, 15, 5 degrees if there is no room for finer ones
    logarithmic,  // at powers of ten
};

// One axis of a chart. `value(t)` is the physical value at t in [0, 1] along the axis, from left to
// right or from the bottom up. It is monotonic but not necessarily linear; it may be a table's
// mapping.
struct ChartAxis {
    std::string title;  // "sun zenith angle (deg)"
    std::function<double(double)> value;
    AxisTicks ticks = AxisTicks::decimal;
    bool begins_at_zero = false;  // the low end of a logarithmic axis stands for 0 and less
};

ChartAxis linear_axis(std::string title, double low, double high);
ChartAxis logarithmic_axis(std::string title, double low, double high);

// Returns an axis over the values that can be shown. A single value has some room around it;
// without values the axis is around 1. A logarithmic axis has at most 12 decades. `room` is the
// share of the axis that stays empty at both ends; a linear axis that ends at 0 has no room at that
// end.
ChartAxis axis_over(std::string title, const std::vector<double>& values, bool logarithmic,
                    double room);

// Returns a logarithmic axis whose ends are 1, 2 or 5 times a power of ten and at least a quarter
// beyond the values. `smallest` is positive. Values below it count as `smallest`, and then the axis
// begins there with a tick labelled 0. Values that are not finite are ignored.
ChartAxis rounded_axis(std::string title, const std::vector<double>& values, double smallest);

// Whether an axis has a place for a value: it is finite, and has a logarithm if it needs one.
bool can_show(const ChartAxis& axis, double value);

// Returns the place of the value on the axis, in [0, 1]: the nearer end if the value is beyond the
// axis, 1 if it is not a number.
double place_on(const ChartAxis& axis, double value);

struct AxisTick {
    double t = 0;  // along the axis, in [0, 1]
    double value = 0;
    std::string label;
};

// Returns ticks at round numbers, at least `gap` apart along the axis, ascending in t. If a part of
// the axis is stretched, it has finer ticks between the coarse ones. An axis whose value does not
// change or is not finite has no ticks.
std::vector<AxisTick> axis_ticks(const ChartAxis& axis, double gap);

// Returns the places of 2 to 9 times powers of ten on a logarithmic axis, for short ticks without
// labels. There are none on other axes, and none if they are less than `gap` apart.
std::vector<double> minor_ticks(const ChartAxis& axis, double gap);

// Returns a number as people write it: "0.25", "−5", "2×10⁻⁵".
std::string number_label(double value);

}  // namespace skybake
