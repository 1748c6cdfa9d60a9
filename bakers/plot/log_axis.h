// A logarithmic axis: its range and its ticks.
#pragma once

#include <string>
#include <vector>

namespace skybake {

struct LogTick {
    double value = 0;
    std::string label;  // empty: a short tick without words
};

class LogAxis {
  public:
    // An axis about the values, with ends at 1, 2 or 5 times a power of ten and room beside the
    // outermost. Values below `smallest`, which is positive, count as that, and the axis begins
    // there with a tick called 0. Values that are not finite are left out.
    LogAxis(const std::vector<double>& values, double smallest);

    // Where a value stands: 0 at the axis' low end, 1 at its high one.
    double position(double value) const;

    // Ascending; powers of ten carry labels, and on a short axis 2 and 5 times them too.
    std::vector<LogTick> ticks() const;

    double low() const { return low_; }
    double high() const { return high_; }

  private:
    double smallest_;
    double low_;
    double high_;
};

}  // namespace skybake
