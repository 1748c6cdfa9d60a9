// An interruption in the middle of a report or a plan.
#pragma once

#include <atomic>
#include <string_view>

#include "bakers/math/bake_options.h"

namespace skybake::testing {

// Cancels once `step` has advanced so many times.
class CancelledAt : public Progress {
  public:
    CancelledAt(std::string_view step, int times) : step_(step), times_(times) {}
    void advance(std::string_view step, double) override {
        if (step == step_) ++seen_;
    }
    bool cancelled() const override { return seen_ >= times_; }

  private:
    std::string_view step_;
    int times_;
    std::atomic<int> seen_ = 0;
};

}  // namespace skybake::testing
