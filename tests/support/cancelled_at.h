// An interruption in the middle of what is done.
#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <string_view>

#include "bakers/math/bake_options.h"

namespace skybake::testing {

// Cancels once `step` has advanced so many times, or this far; if it is empty, once any step has.
class CancelledAt : public Progress {
  public:
    CancelledAt(std::string_view step, int times, double fraction = 2)
        : step_(step), times_(times), fraction_(fraction) {}
    void advance(std::string_view step, double fraction) override {
        EXPECT_TRUE(fraction >= 0 && fraction <= 1);
        if (!step_.empty() && step != step_) return;
        EXPECT_TRUE(!in_order || fraction >= last);
        ++seen;
        last = fraction;
    }
    bool cancelled() const override { return seen >= times_ || last >= fraction_; }

    bool in_order = false;  // fails where a fraction is smaller than the one before
    std::atomic<int> seen = 0;
    std::atomic<double> last = 0;

  private:
    std::string_view step_;
    int times_;
    double fraction_;
};

}  // namespace skybake::testing
