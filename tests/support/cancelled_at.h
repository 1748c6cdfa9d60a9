// An interruption in the middle of what is done.
#pragma once

#include <atomic>
#include <string_view>

#include "bakers/math/bake_options.h"

namespace skybake::testing {

// Cancels once `step` has advanced so many times; if it is empty, once any step has.
class CancelledAt : public Progress {
  public:
    CancelledAt(std::string_view step, int times) : step_(step), times_(times) {}
    void advance(std::string_view step, double) override {
        if (step_.empty() || step == step_) ++seen_;
    }
    bool cancelled() const override { return seen_ >= times_; }

  private:
    std::string_view step_;
    int times_;
    std::atomic<int> seen_ = 0;
};

}  // namespace skybake::testing
