// Maximum and root mean square of a series of errors, in the order given.
#pragma once

#include <cmath>

#include "bakers/field/baked.h"

namespace skybake {

class ErrorStatistics {
  public:
    void add(double error) {
        const double size = std::fabs(error);
        if (size > max_ || std::isnan(size)) max_ = size;  // NaN stays: no bound accepts it
        sum_of_squares_ += error * error;
        ++count_;
    }
    ErrorFigures figures() const {
        return {max_, count_ == 0 ? 0 : std::sqrt(sum_of_squares_ / static_cast<double>(count_))};
    }
    double max() const { return max_; }

  private:
    double max_ = 0;
    double sum_of_squares_ = 0;
    long count_ = 0;
};

}  // namespace skybake
