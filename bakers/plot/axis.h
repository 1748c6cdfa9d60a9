// The axes of charts: what they show, where a value stands, and what is written beside them.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace skybake {

enum class AxisTicks {
    decimal,      // at 1, 2 and 5 times powers of ten
    angles,       // at 90, 30, 15, 5 degrees where there is no room for finer ones
    logarithmic,  // at powers of ten
};

// One axis of a chart: `value(t)` is the physical value at t in [0, 1] along it, monotonic, not
// necessarily linear (a table's mapping), from left to right or from the bottom up.
struct ChartAxis {
    std::string title;  // "sun zenith angle (deg)"
    std::function<double(double)> value;
    AxisTicks ticks = AxisTicks::decimal;
    bool begins_at_zero = false;  // the low end of a logarithmic axis stands for 0 and less
};

ChartAxis linear_axis(std::string title, double low, double high);
ChartAxis logarithmic_axis(std::string title, double low, double high);

// An axis over the values that can be shown. One value alone has some room about it; without any
// the axis is about 1. A logarithmic one has at most 12 decades. `room` is the share of the axis
// that is left empty beyond both ends; a linear axis that ends at 0 has none there.
ChartAxis axis_over(std::string title, const std::vector<double>& values, bool logarithmic,
                    double room);

// A logarithmic axis whose ends are 1, 2 or 5 times a power of ten and at least a quarter beyond
// the values. Values below `smallest`, which is positive, count as that, and the axis begins there
// with a tick called 0. Values that are not finite are left out.
ChartAxis rounded_axis(std::string title, const std::vector<double>& values, double smallest);

// Whether an axis has a place for a value: it is finite, and has a logarithm if it needs one.
bool can_show(const ChartAxis& axis, double value);

// Where the axis has the value, in [0, 1]: at the nearer end if it is beyond both, at 1 if it is
// not a number.
double place_on(const ChartAxis& axis, double value);

struct AxisTick {
    double t = 0;  // along the axis, in [0, 1]
    double value = 0;
    std::string label;
};

// Round numbers at least `gap` apart along the axis, ascending in t. Where the axis is stretched,
// finer ones stand between the coarse ones. None on an axis whose value does not change or is not
// finite.
std::vector<AxisTick> axis_ticks(const ChartAxis& axis, double gap);

// Where 2 to 9 times powers of ten are on a logarithmic axis, for short ticks without labels: none
// on other axes, and none where they are less than `gap` apart.
std::vector<double> minor_ticks(const ChartAxis& axis, double gap);

// A number as people write it: "0.25", "−5", "2×10⁻⁵".
std::string number_label(double value);

}  // namespace skybake
